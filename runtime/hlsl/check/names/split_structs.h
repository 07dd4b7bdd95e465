// SPDX-License-Identifier: MIT
//
// A global struct that holds resources: DXC gives each resource a register of its own and leaves
// the rest where the struct would be in its constant buffer. A resource takes no memory there, but
// an array of them, or a struct of them, ends the row all the same.
// [DXC: CGMSHLSLRuntime::ConstructStructAnnotation]
#pragma once

#include <cstdint>
#include <string>

#include "runtime/hlsl/check/names/buffer_members.h"
#include "runtime/hlsl/check/names/names_part.h"

namespace kaamos::hlsl {

class SplitStructs : NamesPart {
 public:
  using NamesPart::NamesPart;

  // Adds the memory to `members`, the struct of `buffer`, and tells where in it each part is.
  void declare_split(const VariableDecl* decl, const Type* type, Scope* scope, BindingInfo* buffer,
                     ir::Struct* members, BufferMember* member);

 private:
  struct SplitPlan;
  SplitPart split(const Type* type, const std::string& name, SplitPlan& plan);
  SplitPart split_memory(const Type* type, const std::string& name, SplitPlan& plan);
  SplitPart split_resource(const Type* type, const std::string& name, SplitPlan& plan);
};

}  // namespace kaamos::hlsl
