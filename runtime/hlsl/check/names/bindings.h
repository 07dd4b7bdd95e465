// SPDX-License-Identifier: MIT
//
// Resources and constant buffers, and the registers that the source gives them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/hlsl/check/names/names_part.h"

namespace kaamos::hlsl {

class Bindings : NamesPart {
 public:
  using NamesPart::NamesPart;

  void declare_binding(const VariableDecl* decl, const Type* type, Scope* scope);
  VariableInfo* make_binding(const std::string& name, const Type* type, SourceLocation location);
  void declare_buffer(const BufferDecl* decl, Scope* scope);
  void declare_uniform(const VariableDecl* decl, const Type* type, Scope* scope);
  void assign_known_registers();

  // Each unit has a $Globals of its own.
  void begin_unit() {
    globals_buffer_ = nullptr;
    globals_offset_ = 0;
    globals_.clear();
  }
  // After the last declaration of a unit: moves the members of $Globals to where register(cN) wants
  // them, and those without one behind them.
  void place_globals();

 private:
  // A member of $Globals, or a part of one that holds resources.
  struct GlobalMember {
    VariableInfo* variable;
    size_t field;          // of the buffer's struct
    bool begins_row;       // 16 bytes
    int64_t written = -1;  // its offset by register(cN)
  };

  void open_globals_buffer(SourceLocation location);
  int64_t constant_register(const VariableDecl* decl, const Type* type);
  void note_split_globals(size_t first_variable, size_t first_field);
  void apply_register(BindingInfo* binding, const Annotations& annotations);

  BindingInfo* globals_buffer_ = nullptr;  // $Globals of the unit that is being declared
  ir::Struct* globals_struct_ = nullptr;
  uint32_t globals_offset_ = 0;
  std::vector<GlobalMember> globals_;
};

}  // namespace kaamos::hlsl
