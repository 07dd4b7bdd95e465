// SPDX-License-Identifier: MIT
//
// Structs, their members and bit fields.
#pragma once

#include <set>
#include <string>
#include <unordered_map>

#include "runtime/hlsl/check/names/names_part.h"

namespace kaamos::hlsl {

class Structs : NamesPart {
 public:
  using NamesPart::NamesPart;

  void declare_struct(const StructDecl* decl, Scope* scope);
  StructInfo* make_struct(const StructDecl* decl, Scope* parent, const std::string& name);
  void complete_struct(StructInfo* info);

 private:
  void warn_of_width(const VariableDecl* decl, const Type* type, Scope* scope);
  void check_interfaces(StructInfo* info);
  void declare_member(StructInfo* info, const Decl* member);
  void declare_bit_field(StructInfo* info, const VariableDecl* decl, const Type* type);
  void reuse_struct(StructInfo* info);

  std::set<std::string> names_;
  // The structs of libraries that are linked.
  std::unordered_multimap<std::string, const StructInfo*> by_name_;
};

}  // namespace kaamos::hlsl
