// SPDX-License-Identifier: MIT
#include "runtime/vulkan/gpu/workarounds.h"

#include <gtest/gtest.h>

#include "kaamos/shader/spirv_interface.h"

namespace kaamos::vulkan {
namespace {

constexpr char kMesa[] = "Mesa 25.0.7-2~bpo12+1 (LLVM 15.0.6)";

Workarounds of(VkDriverId driver, const char* info, const char* disabled = "",
               const char* enabled = "") {
  std::vector<std::string> unknown;
  return workarounds_for(driver, info, disabled, enabled, &unknown);
}

TEST(Workarounds, VersionsAreRead) {
  EXPECT_EQ(driver_version(kMesa), 25000u);
  EXPECT_EQ(driver_version("Mesa 24.3.1"), 24003u);
  EXPECT_EQ(driver_version("535.104"), 0u);
  EXPECT_EQ(driver_version("Mesa "), 0u);
  EXPECT_EQ(driver_version(""), 0u);
}

TEST(Workarounds, AreForTheirDriverOnly) {
  const Workarounds lavapipe = of(VK_DRIVER_ID_MESA_LLVMPIPE, kMesa);
  EXPECT_TRUE(lavapipe.has(Workaround::kOwnIntersectionStages));
  EXPECT_TRUE(lavapipe.has(Workaround::kSortPrimitives));
  EXPECT_TRUE(lavapipe.has(Workaround::kPadBoxes));
  EXPECT_EQ(lavapipe.shader_bits(),
            shader::spirv::kRestoreAttributes | shader::spirv::kCopyHitBuiltins |
                shader::spirv::kTrackReportedT | shader::spirv::kInterleaveRows);
  const Workarounds nvidia = of(VK_DRIVER_ID_NVIDIA_PROPRIETARY, "550.40");
  EXPECT_EQ(nvidia.shader_bits(), 0u);
  for (const WorkaroundInfo& info : workaround_table()) {
    EXPECT_EQ(nvidia.has(info.workaround), info.driver == VK_DRIVER_ID_NVIDIA_PROPRIETARY)
        << info.name;
  }
  EXPECT_TRUE(nvidia.has(Workaround::kLimitDepth));
}

TEST(Workarounds, EachHasASwitch) {
  for (const WorkaroundInfo& info : workaround_table()) {
    const std::string list = std::string("none,") + info.name;
    EXPECT_TRUE(of(info.driver, kMesa, "", info.name).has(info.workaround)) << info.name;
    const Workarounds without = of(info.driver, kMesa, list.c_str(), "all");
    EXPECT_FALSE(without.has(info.workaround)) << info.name;
    EXPECT_EQ(without.shader_bits() & info.shader_bit, 0u) << info.name;
  }
  EXPECT_TRUE(of(VK_DRIVER_ID_MESA_LLVMPIPE, kMesa, "B1").has(Workaround::kInterleaveRows));
  EXPECT_FALSE(of(VK_DRIVER_ID_MESA_LLVMPIPE, kMesa, "all").has(Workaround::kCopyHitBuiltins));
}

TEST(Workarounds, NamesThatAreNoneAreReported) {
  std::vector<std::string> unknown;
  workarounds_for(VK_DRIVER_ID_MESA_LLVMPIPE, kMesa, "B1,B99,,b1", "SORT,x", &unknown);
  EXPECT_EQ(unknown, (std::vector<std::string>{"B99", "b1", "x"}));
}

}  // namespace
}  // namespace kaamos::vulkan
