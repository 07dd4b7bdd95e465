// SPDX-License-Identifier: MIT
//
// Resources and constant buffers, and the registers that the source gives them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/hlsl/check/names/buffer_members.h"
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
    globals_.clear();
  }
  // After the last declaration of a unit.
  void place_globals();

 private:
  void open_globals_buffer(SourceLocation location);
  BufferMember make_member(const VariableDecl* decl, const Type* type, Scope* scope,
                           BindingInfo* buffer, ir::Struct* structure);
  void report_overlaps(const std::vector<BufferMember>& members);
  int64_t pack_offset(const VariableDecl* decl, const BufferMember& member);
  int64_t constant_register(const VariableDecl* decl, const BufferMember& member);
  void place(const std::vector<BufferMember>& members, BindingInfo* buffer, ir::Struct* structure);
  void apply_register(BindingInfo* binding, const Annotations& annotations);

  BindingInfo* globals_buffer_ = nullptr;  // $Globals of the unit that is being declared
  ir::Struct* globals_struct_ = nullptr;
  std::vector<BufferMember> globals_;
};

}  // namespace kaamos::hlsl
