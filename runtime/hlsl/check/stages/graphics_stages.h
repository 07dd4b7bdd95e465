// SPDX-License-Identifier: MIT
//
// The inputs and outputs of vertex, geometry and pixel shaders. Parameters, fields of structs,
// elements of arrays and rows of matrices are taken apart into scalars and vectors of 32-bit
// numbers: an entry point is generated that has one parameter for each, and calls the function of
// the source.
#pragma once

#include "runtime/hlsl/check/stages/geometry_shape.h"
#include "runtime/hlsl/check/stages/stage_part.h"

namespace kaamos::hlsl {

class GraphicsStages : StagePart {
 public:
  GraphicsStages(Program& program, Lowerer& lowerer)
      : StagePart(program, lowerer), geometry_(program, lowerer) {}

  bool check_graphics_signature(FunctionInfo* function, ir::EntryPoint& entry);

 private:
  bool read_waves_of_helpers(const FunctionInfo& function, const ir::EntryPoint& entry);
  // The static global that says whether a pixel may still write.
  const ir::Variable* live_variable();

  GeometryShapes geometry_;
};

}  // namespace kaamos::hlsl
