// SPDX-License-Identifier: MIT
//
// Compute shaders as entry points.
#pragma once

#include "runtime/hlsl/check/stages/stage_part.h"

namespace kaamos::hlsl {

class ComputeStage : StagePart {
 public:
  using StagePart::StagePart;

  bool check_compute_parameters(FunctionInfo* function, ir::EntryPoint& entry);

 private:
  bool read_thread_group(FunctionInfo* function, ir::EntryPoint& entry);
  bool read_groupshared_limit(FunctionInfo* function, ir::EntryPoint& entry);
  bool read_wave_size(FunctionInfo* function, ir::EntryPoint& entry);
};

}  // namespace kaamos::hlsl
