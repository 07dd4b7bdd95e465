// SPDX-License-Identifier: MIT
//
// [WaveSize] and [GroupSharedLimit]: pipelines that ask for more than the device has are refused.
#include <gtest/gtest.h>
#include <kaamos/shader/abi.h>

#include <cstring>

#include "executors.h"
#include "fixtures.h"
#include "tests/vulkan/support.h"

namespace kaamos::test {
namespace {

// WaveGetLaneCount() in a shader with the attribute.
hlsl::Result<uint32_t> lanes_with(const std::string& attribute, const std::string& backend,
                                  uint32_t wave_lanes) {
  hlsl::FrontendOptions options;
  options.path = "size.hlsl";
  options.target = "lib_6_8";
  options.text = "RWByteAddressBuffer results : register(u0);\n[shader(\"compute\")] " + attribute +
                 " [numthreads(4, 1, 1)]\nvoid main() { results.Store(0, WaveGetLaneCount()); }\n";
  const Compiled code =
      backend == "vulkan" ? compile_vulkan(options) : compile_interpreted(options);
  if (code.library == nullptr) return hlsl::Failure{code.error};
  const auto bytes = run_on_device(backend, *code.library, {1, 1, 1}, nullptr, wave_lanes);
  if (!bytes) return hlsl::Failure{bytes.error()};
  uint32_t lanes = 0;
  std::memcpy(&lanes, bytes->data(), sizeof(lanes));
  return lanes;
}

// As text: the number, or the error.
std::string told_with(const std::string& attribute, const std::string& backend,
                      uint32_t wave_lanes) {
  const auto lanes = lanes_with(attribute, backend, wave_lanes);
  return lanes ? std::to_string(*lanes) : lanes.error();
}

TEST(WaveSize, IsWhatTheDeviceHasOrAnError) {
  EXPECT_EQ(told_with("[WaveSize(16)]", "embree", 16), "16");
  EXPECT_EQ(told_with("[WaveSize(4, 32)]", "embree", 8), "8");
  EXPECT_EQ(told_with("[WaveSize(4, 32, 16)]", "embree", 32), "32");
  for (const char* attribute : {"[WaveSize(16)]", "[WaveSize(64)]", "[WaveSize(16, 32)]"}) {
    const std::string error = lanes_with(attribute, "embree", 8).error();
    EXPECT_NE(error.find("KA0550"), std::string::npos) << attribute << error;
    EXPECT_NE(error.find("those of this device have 8"), std::string::npos) << error;
  }
}

TEST(WaveSize, IsWhatTheVulkanDeviceHasOrAnError) {
  KAAMOS_NEED_VULKAN();
  const auto lanes = lanes_with("", "vulkan", 0);
  ASSERT_TRUE(lanes) << lanes.error();
  const std::string count = std::to_string(*lanes);
  EXPECT_EQ(told_with("[WaveSize(" + count + ")]", "vulkan", 0), count);
  EXPECT_EQ(told_with("[WaveSize(4, 128)]", "vulkan", 0), count);
  const std::string error = lanes_with("[WaveSize(128)]", "vulkan", 0).error();
  EXPECT_NE(error.find("KA0550"), std::string::npos) << error;
}

// The sum of twice as many groupshared uints, which 64 threads have written.
hlsl::Result<uint32_t> sum_of_groupshared(uint32_t words, const std::string& backend) {
  hlsl::FrontendOptions options;
  options.path = "groupshared.hlsl";
  options.target = "lib_6_10";
  options.experimental = true;
  options.text = "static const uint kWords = " + std::to_string(words) + R"(;
groupshared uint words[kWords], more[kWords];
RWByteAddressBuffer results : register(u0);
[shader("compute")] [GroupSharedLimit(8 * kWords)] [numthreads(64, 1, 1)]
void main(uint thread : SV_GroupIndex) {
  for (uint i = thread; i < kWords; i += 64) words[i] = more[i] = i % 7;
  GroupMemoryBarrierWithGroupSync();
  if (thread != 0) return;
  uint sum = 0;
  for (uint k = 0; k < kWords; ++k) sum += words[k] + more[k];
  results.Store(0, sum);
}
)";
  const Compiled code =
      backend == "vulkan" ? compile_vulkan(options) : compile_interpreted(options);
  if (code.library == nullptr) return hlsl::Failure{code.error};
  const auto bytes = run_on_device(backend, *code.library, {1, 1, 1});
  if (!bytes) return hlsl::Failure{bytes.error()};
  uint32_t sum = 0;
  std::memcpy(&sum, bytes->data(), sizeof(sum));
  return sum;
}

constexpr uint32_t kWords = 100000;  // 800,000 bytes
constexpr uint32_t kSum = 2 * (kWords / 7 * 21 + 0 + 1 + 2 + 3 + 4);
static_assert(kWords % 7 == 5);

TEST(GroupSharedLimit, AllowsWhatTheDeviceHas) {
  const auto sum = sum_of_groupshared(kWords, "embree");
  ASSERT_TRUE(sum) << sum.error();
  EXPECT_EQ(*sum, kSum);
  const auto error = sum_of_groupshared(3 << 20, "embree");
  ASSERT_FALSE(error);
  EXPECT_NE(error.error().find("KA0552"), std::string::npos) << error.error();
  EXPECT_NE(error.error().find("has 25165824 bytes"), std::string::npos) << error.error();
}

TEST(GroupSharedLimit, AllowsWhatTheVulkanDeviceHas) {
  KAAMOS_NEED_VULKAN();
  const auto sum = sum_of_groupshared(kWords, "vulkan");
  if (sum) {
    EXPECT_EQ(*sum, kSum);
  } else {
    EXPECT_NE(sum.error().find("KA0552"), std::string::npos) << sum.error();
  }
}

}  // namespace
}  // namespace kaamos::test
