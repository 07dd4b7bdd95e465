// SPDX-License-Identifier: MIT
//
// A scene on one backend, and rays into it whose hits are returned in full (probe.hlsl).
#pragma once

#include <rtapi/rtapi.h>
#include <rtapi/shader_table.h>

#include <string>
#include <vector>

#include "effects/assets/scene/scene.h"
#include "effects/engine/gpu_scene.h"
#include "tests/parity/hits.h"

namespace kaamos::parity {

struct ProbeRay {
  float origin[3] = {0, 0, 0};
  float t_min = 0;
  float direction[3] = {0, 0, 1};
  float t_max = 1e30f;
  uint32_t flags = 0;
  uint32_t mask = 0xFF;
};
static_assert(sizeof(ProbeRay) == 40);

// Errors are thrown as rtapi::ResultError.
class Probe {
 public:
  // A scene of the effects with its origin at the first camera.
  Probe(const std::string& backend, const effects::Scene& scene);
  // Instances of everything that DXR has: several geometries, opaque and not, balls in boxes,
  // mirrored, stretched and flat transforms, every mask and instance flag. From -8 to 8 on each
  // axis.
  explicit Probe(const std::string& backend);

  const rtapi::Device& device() const { return device_; }
  // `rays` must be a whole number of rows of `width`.
  std::vector<HitRecord> trace(const std::vector<ProbeRay>& rays, uint32_t width);

 private:
  struct Geometry {
    rtapi::GpuVirtualAddress vertices = 0;
    rtapi::GpuVirtualAddress indices = 0;
    uint32_t index_bytes = 4;
    const char* group = "";
  };
  void open(const std::string& backend);
  void build_mixed();
  rtapi::Buffer upload(const void* data, size_t bytes);
  void create_pipeline();

  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  effects::GpuScene gpu_;
  std::vector<rtapi::Buffer> keep_;
  rtapi::Buffer top_level_;
  std::vector<Geometry> geometries_;
  rtapi::RootSignature global_;
  rtapi::RootSignature local_;
  rtapi::StateObject pipeline_;
  std::vector<rtapi::ShaderTable> tables_;  // ray generation, miss, hit groups
};

}  // namespace kaamos::parity
