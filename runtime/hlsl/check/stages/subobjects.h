// SPDX-License-Identifier: MIT
//
// Subobjects written in HLSL. [DXR: Subobjects in HLSL]
#pragma once

#include "runtime/hlsl/check/stages/stage_part.h"

namespace kaamos::hlsl {

class Subobjects : StagePart {
 public:
  using StagePart::StagePart;

  void declare_subobject(const SubobjectDecl* decl);
};

}  // namespace kaamos::hlsl
