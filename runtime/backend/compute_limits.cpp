// SPDX-License-Identifier: MIT
#include "runtime/backend/compute_limits.h"

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

rtapi::Status check_groupshared(const LinkedCompute& pipeline, uint64_t most_bytes) {
  const uint64_t bytes = pipeline.shader.code->compute->shared_bytes;
  if (bytes <= most_bytes) return {};
  return make_error(Id::kGroupsharedMemory, "compute shader \"" + pipeline.shader.name + "\" has " +
                                                std::to_string(bytes) +
                                                " bytes of groupshared memory; this device has " +
                                                std::to_string(most_bytes) + " for a group.");
}

}  // namespace kaamos::runtime
