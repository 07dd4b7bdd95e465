// SPDX-License-Identifier: MIT
#include "runtime/backend/wave_size.h"

#include "runtime/backend/errors.h"

namespace kaamos::runtime {

rtapi::Status check_wave_size(const LinkedCompute& pipeline, uint32_t least, uint32_t most,
                              const std::string& device) {
  const shader::ComputeDesc& compute = *pipeline.shader.code->compute;
  const bool any = compute.most_wave_lanes == 0;
  if (any || (compute.least_wave_lanes <= most && least <= compute.most_wave_lanes)) return {};
  std::string asked = std::to_string(compute.least_wave_lanes);
  if (compute.most_wave_lanes != compute.least_wave_lanes) {
    asked += " to " + std::to_string(compute.most_wave_lanes);
  }
  return make_error(Id::kWaveSize, "compute shader \"" + pipeline.shader.name +
                                       "\" needs waves of " + asked + " lanes [WaveSize]; " +
                                       device);
}

}  // namespace kaamos::runtime
