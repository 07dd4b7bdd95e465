// SPDX-License-Identifier: MIT
//
// A device of one backend, and what the tests of this folder make on it.
#pragma once

#include <gmock/gmock.h>
#include <rtapi/rtapi.h>
#include <rtapi/shader_table.h>
#include <rtapi/upload.h>

#include <string>
#include <vector>

#include "tests/vulkan/on_backends.h"

namespace kaamos::observed {

class World : public test::OnBackends {
 protected:
  void SetUp() override;
  void open(bool checked = false);

  rtapi::Buffer zeros(uint64_t bytes, const std::string& name);
  std::vector<uint32_t> read(const rtapi::Buffer& words);

  // A structure whose inputs are no longer needed.
  rtapi::Buffer build(const rtapi::BuildRaytracingAccelerationStructureInputs& inputs,
                      const std::string& name);
  // One instance, with this flag of the geometry, of boxes or of the triangle around (0, 0) at z
  // = 5.
  rtapi::Buffer boxes(const std::vector<rtapi::RaytracingAabb>& boxes,
                      rtapi::RaytracingAccelerationStructureBuildFlags flags =
                          rtapi::RaytracingAccelerationStructureBuildFlags::kNone);
  rtapi::Buffer triangle();
  rtapi::Buffer instance_of(const rtapi::Buffer& bottom_level);

  // Root parameters: UAV(u0), SRV(t0), 4 constants at b0, a table of views, and in space 2 a point
  // sampler.
  enum Parameter : uint32_t { kOut, kScene, kConstants, kViews };
  static constexpr uint32_t kViewCount = 16;
  void bind(rtapi::CommandList& list);
  void dispatch(const rtapi::ShaderLibrary& library, const char* entry);

  struct Tables {
    explicit Tables(const rtapi::StateObject& pipeline)
        : ray_generation(pipeline, "ray generation table"),
          miss(pipeline, "miss table"),
          hit(pipeline, "hit table") {}
    rtapi::ShaderTable ray_generation, miss, hit;
    rtapi::DispatchRaysDesc desc(uint32_t width) const;
  };
  Tables tables_of(const rtapi::StateObject& pipeline, const std::string& ray_generation,
                   const std::string& hit_group);

  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  rtapi::RootSignature root_;
  rtapi::DescriptorHeap views_;
  rtapi::Buffer out_;
  rtapi::Buffer scene_;
  uint32_t constants_[4] = {0, 0, 0, 0};
  std::vector<rtapi::Message> messages_;
  std::vector<rtapi::Buffer> keep_;
};

#define KAAMOS_OBSERVED(suite)                                                   \
  class suite : public kaamos::observed::World {};                               \
  INSTANTIATE_TEST_SUITE_P(Backends, suite, testing::Values("embree", "vulkan"), \
                           [](const auto& tested) { return std::string(tested.param); })

}  // namespace kaamos::observed
