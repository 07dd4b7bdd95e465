// SPDX-License-Identifier: MIT
//
// One test for each call (and each kind of it) on each backend; table.sh makes the table of
// rtapi/SUPPORT.md from their results. The suite's name is the table row, the test's name what
// works.
#pragma once

#include <gtest/gtest.h>
#include <rtapi/rtapi.h>
#include <rtapi/shader_table.h>
#include <rtapi/upload.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

namespace kaamos::support {

constexpr uint32_t kCount = 8;  // numbers that a shader writes

// If the backend refuses a call as unsupported, the test ends as skipped, which is "no" in the
// table.
#define KAAMOS_SUPPORTED(status)                                                             \
  do {                                                                                       \
    const auto& kaamos_status = (status);                                                    \
    if (!kaamos_status.ok() && kaamos_status.error().code == rtapi::ErrorCode::kUnsupported) \
      GTEST_SKIP() << "not supported: " << kaamos_status.error().message;                    \
    ASSERT_TRUE(kaamos_status.ok()) << kaamos_status.error().message;                        \
  } while (false)

class Call : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override;
  // Makes the device and everything that each test uses.
  void open(const rtapi::DeviceDesc& desc);

  rtapi::Buffer upload(const std::vector<uint32_t>& words);
  rtapi::Buffer buffer(uint64_t bytes,
                       rtapi::ResourceStates state = rtapi::ResourceStates::kUnorderedAccess);
  std::vector<uint32_t> read(const rtapi::Buffer& words);
  rtapi::Texture texture(uint32_t width = kCount);  // R8G8B8A8, writable
  rtapi::Texture texture_of(uint32_t first);        // its texels are first, first + 1, ...
  rtapi::ShaderLibrary library();

  // Binds the root signature, out_ and the table, runs `entry` with kCount threads, and returns
  // out_.
  std::vector<uint32_t> compute(const char* entry);
  // The views of the table by their slot.
  enum Slot : uint32_t {
    kStructured,
    kTyped,
    kRaw,
    kTexture,
    kScene,
    kTypedOut,
    kTextureOut,
    kConstants,
    kAppended,
    kConsumed,
    kCounted,
    kSlots
  };
  rtapi::CpuDescriptorHandle slot(Slot slot) { return views_.GetCPUDescriptorHandle(slot); }
  void bind(rtapi::CommandList& list);

  // A bottom level of triangles at x = 0, 1, ... or of boxes, and an instance of it with InstanceID
  // 4.
  rtapi::Result<rtapi::Buffer> bottom_level(
      uint32_t primitives, bool boxes = false,
      rtapi::RaytracingAccelerationStructureBuildFlags flags =
          rtapi::RaytracingAccelerationStructureBuildFlags::kNone,
      const rtapi::Buffer* update_of = nullptr, float shift = 0);
  rtapi::Result<rtapi::Buffer> top_level(const rtapi::Buffer& bottom_level);
  rtapi::Result<rtapi::Buffer> build(
      const rtapi::BuildRaytracingAccelerationStructureInputs& inputs,
      const rtapi::Buffer* update_of = nullptr);

  // A pipeline and its tables, and what its rays wrote.
  struct Rays {
    std::string ray_generation = "TraceRootView";
    std::string closest_hit = "Hit";
    std::string any_hit;
    std::string intersection;
    std::vector<std::string> callables;
    uint32_t recursion = 1;
    bool local_arguments = false;
  };
  rtapi::StateObjectDesc describe(const Rays& rays);
  std::vector<uint32_t> trace(const Rays& rays, const rtapi::Buffer& top_level);
  std::vector<uint32_t> trace(const Rays& rays, const rtapi::StateObject& pipeline,
                              const rtapi::Buffer& top_level);

  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  rtapi::RootSignature root_;
  rtapi::RootSignature local_;
  rtapi::DescriptorHeap views_;
  rtapi::DescriptorHeap samplers_;
  rtapi::Buffer out_;
  rtapi::Buffer words_;  // the local arguments: 50, 51, ...
  std::vector<rtapi::Buffer> keep_;
  uint32_t constants_[2] = {3, 2};
};

// first, first + step, ...
std::vector<uint32_t> numbers(uint32_t first, uint32_t step = 1, uint32_t count = kCount);

// Registers a suite for both backends.
#define KAAMOS_CALLS(suite)                                                      \
  class suite : public kaamos::support::Call {};                                 \
  INSTANTIATE_TEST_SUITE_P(Backends, suite, testing::Values("embree", "vulkan"), \
                           [](const auto& tested) { return std::string(tested.param); })

}  // namespace kaamos::support
