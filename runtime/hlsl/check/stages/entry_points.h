// SPDX-License-Identifier: MIT
//
// Entry points and their signatures. [DXR: Shader stages]
#pragma once

#include <cstdint>
#include <string>

#include "runtime/hlsl/check/stages/compute_stage.h"
#include "runtime/hlsl/check/stages/exports.h"
#include "runtime/hlsl/check/stages/graphics_stages.h"
#include "runtime/hlsl/check/stages/stage_part.h"

namespace kaamos::hlsl {

class EntryPoints : StagePart {
 public:
  EntryPoints(Program& program, Lowerer& lowerer, Exports& exports)
      : StagePart(program, lowerer),
        exports_(exports),
        compute_(program, lowerer),
        graphics_(program, lowerer) {}

  void find_entry_points();
  void add_library_functions();

 private:
  void check_entry_point(FunctionInfo* function, uint32_t stage, const std::string& name);
  bool check_ray_parameters(FunctionInfo* function, ir::EntryPoint& entry);
  uint32_t stage_attribute(FunctionInfo* function);
  void name_thread(FunctionInfo& function);
  void wrap_payload(FunctionInfo* function, ir::EntryPoint& entry);

  Exports& exports_;
  ComputeStage compute_;
  GraphicsStages graphics_;
};

}  // namespace kaamos::hlsl
