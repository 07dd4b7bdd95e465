// SPDX-License-Identifier: MIT
//
// Initialisers of static globals, which are lowered at their first use.
#pragma once

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Initialisers : LowerPart {
 public:
  using LowerPart::LowerPart;

  void initialise(VariableInfo* variable);

 private:
  void check_initialiser_imports(const VariableInfo& variable);
};

}  // namespace kaamos::hlsl
