// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/name_parts.h"

namespace kaamos::hlsl {

NamesPart::NamesPart(NameParts& parts)
    : parts_(parts),
      program_(parts.program),
      bench_(program_.bench),
      scopes_(program_.scopes),
      messages_(bench_.messages),
      types_(bench_.types),
      build_(bench_.build) {}

}  // namespace kaamos::hlsl
