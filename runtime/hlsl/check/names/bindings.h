// SPDX-License-Identifier: MIT
//
// Resources and constant buffers, and the registers that the source gives them.
#pragma once

#include <cstdint>
#include <string>

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
  }

 private:
  void open_globals_buffer(SourceLocation location);
  void apply_register(BindingInfo* binding, const Annotations& annotations);

  BindingInfo* globals_buffer_ = nullptr;  // $Globals of the unit that is being declared
  ir::Struct* globals_struct_ = nullptr;
  uint32_t globals_offset_ = 0;
};

}  // namespace kaamos::hlsl
