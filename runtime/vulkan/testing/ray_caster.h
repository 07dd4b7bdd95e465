// SPDX-License-Identifier: MIT
//
// Casts rays into a top level with a ray tracing pipeline of four small shaders, and returns what
// each ray hit, in the application's numbers.
#pragma once

#include <memory>
#include <vector>

#include "runtime/vulkan/testing/scene_harness.h"

namespace kaamos::vulkan::testing {

struct CastRay {
  float origin[3] = {0, 0, 0};
  float t_min = 0;
  float direction[3] = {0, 0, 1};
  float t_max = 100;
};

// Boxes are hit at t = 1 + PrimitiveIndex, so that the lowest index visited wins.
struct CastHit {
  float t = -1;  // a miss
  uint32_t instance = 0;
  uint32_t instance_id = 0;
  uint32_t geometry = 0;
  uint32_t primitive = 0;
  uint32_t kind = 0;
};

class RayCaster {
 public:
  explicit RayCaster(SceneHarness& scene);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  // `top_level` is looked up in the tables, as shaders do. Instances of boxes have a contribution
  // of 1 to the hit group index, those of triangles 0.
  std::vector<CastHit> cast(uint64_t top_level, const std::vector<CastRay>& rays);
  CastHit cast(uint64_t top_level, const CastRay& ray) {
    return cast(top_level, std::vector{ray}).front();
  }
  // Along +z from (x, y, 0).
  CastHit cast_along_z(uint64_t top_level, float x = 0, float y = 0);
  // The time that the last cast took on the queue, in milliseconds.
  double last_ms() const { return last_ms_; }

 private:
  void create_pipeline();
  void provide_table(uint64_t hit_records);

  SceneHarness& scene_;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  std::vector<VkShaderModule> modules_;
  std::vector<uint8_t> handles_;  // for four groups
  std::unique_ptr<GpuBuffer> table_;
  uint64_t record_bytes_ = 0;
  double last_ms_ = 0;
};

}  // namespace kaamos::vulkan::testing
