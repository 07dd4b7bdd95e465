// SPDX-License-Identifier: MIT
//
// Enums and their enumerators.
#pragma once

#include "runtime/hlsl/check/names/names_part.h"

namespace kaamos::hlsl {

class Enums : NamesPart {
 public:
  using NamesPart::NamesPart;

  void declare_enum(const EnumDecl* decl, Scope* scope);

 private:
  const Type* enumerator_type(const Type* before, int64_t value, bool is_fixed);
  void close_enum(const EnumDecl* decl, EnumInfo* info, Scope* inner);
};

}  // namespace kaamos::hlsl
