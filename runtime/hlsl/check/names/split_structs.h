// SPDX-License-Identifier: MIT
//
// A global struct that holds resources: DXC gives each resource a register of its own and leaves
// the rest where the struct would be in its constant buffer.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/hlsl/check/names/names_part.h"

namespace kaamos::hlsl {

class SplitStructs : NamesPart {
 public:
  using NamesPart::NamesPart;

  void declare_split(const VariableDecl* decl, const Type* type, Scope* scope, BindingInfo* buffer,
                     ir::Struct* members, uint32_t* offset);

 private:
  struct SplitPlan;
  SplitPart split(const Type* type, const std::string& name, SplitPlan& plan);
  SplitPart split_memory(const Type* type, const std::string& name, SplitPlan& plan);
  SplitPart split_resource(const Type* type, const std::string& name, SplitPlan& plan);
};

}  // namespace kaamos::hlsl
