// SPDX-License-Identifier: MIT
//
// [WaveSize]: pipelines whose waves the device does not have are refused.
#include <gtest/gtest.h>
#include <kaamos/shader/abi.h>

#include <cstring>

#include "executors.h"
#include "fixtures.h"
#include "tests/vulkan/support.h"

namespace kaamos::test {
namespace {

// WaveGetLaneCount() in a shader with the attribute; 0, and `error` is set, if it does not run.
uint32_t lanes_with(const std::string& attribute, const std::string& backend, uint32_t wave_lanes,
                    std::string& error) {
  hlsl::FrontendOptions options;
  options.path = "size.hlsl";
  options.target = "lib_6_8";
  options.text = "RWByteAddressBuffer results : register(u0);\n[shader(\"compute\")] " + attribute +
                 " [numthreads(4, 1, 1)]\nvoid main() { results.Store(0, WaveGetLaneCount()); }\n";
  const Compiled code =
      backend == "vulkan" ? compile_vulkan(options) : compile_interpreted(options);
  error = code.error;
  if (code.library == nullptr) return 0;
  const std::vector<std::byte> bytes =
      run_on_device(backend, *code.library, {1, 1, 1}, error, nullptr, wave_lanes);
  uint32_t lanes = 0;
  if (error.empty()) std::memcpy(&lanes, bytes.data(), sizeof(lanes));
  return lanes;
}

TEST(WaveSize, IsWhatTheDeviceHasOrAnError) {
  std::string error;
  EXPECT_EQ(lanes_with("[WaveSize(16)]", "embree", 16, error), 16u) << error;
  EXPECT_EQ(lanes_with("[WaveSize(4, 32)]", "embree", 8, error), 8u) << error;
  EXPECT_EQ(lanes_with("[WaveSize(4, 32, 16)]", "embree", 32, error), 32u) << error;
  for (const char* attribute : {"[WaveSize(16)]", "[WaveSize(64)]", "[WaveSize(16, 32)]"}) {
    EXPECT_EQ(lanes_with(attribute, "embree", 8, error), 0u) << attribute;
    EXPECT_NE(error.find("KA0550"), std::string::npos) << error;
    EXPECT_NE(error.find("those of this device have 8"), std::string::npos) << error;
  }
}

TEST(WaveSize, IsWhatTheVulkanDeviceHasOrAnError) {
  KAAMOS_NEED_VULKAN();
  std::string error;
  const uint32_t lanes = lanes_with("", "vulkan", 0, error);
  ASSERT_NE(lanes, 0u) << error;
  const std::string own = "[WaveSize(" + std::to_string(lanes) + ")]";
  EXPECT_EQ(lanes_with(own, "vulkan", 0, error), lanes) << error;
  EXPECT_NE(lanes_with("[WaveSize(4, 128)]", "vulkan", 0, error), 0u) << error;
  EXPECT_EQ(lanes_with("[WaveSize(128)]", "vulkan", 0, error), 0u);
  EXPECT_NE(error.find("KA0550"), std::string::npos) << error;
}

}  // namespace
}  // namespace kaamos::test
