// SPDX-License-Identifier: MIT
//
// AT_FIRST_USE: a library that carries HLSL instead of code does what one does that the build
// compiled.
#include <gtest/gtest.h>
#include <rtapi/rtapi.h>
#include <rtapi/upload.h>
#include <shaders/first_use.h>
#include <shaders/first_use_built.h>
#include <shaders/first_use_other.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "tests/vulkan/support.h"

namespace kaamos::shader_tests {
namespace {

using namespace rtapi;

std::vector<std::byte> run(const Device& device, const ShaderLibrary& library) {
  constexpr uint64_t kThreads = 640;
  const CommandQueue queue = device.CreateCommandQueue().value();
  const RootSignature root_signature = device.CreateRootSignature("UAV(u0)").value();
  const PipelineState pipeline =
      device.CreateComputePipelineState({root_signature, library, "Angles", "Angles"}).value();
  const Buffer results = device
                             .CreateBuffer({.SizeInBytes = 4 * kThreads,
                                            .Flags = ResourceFlags::kAllowUnorderedAccess})
                             .value();
  CommandList list = device.CreateCommandList().value();
  list.SetComputeRootSignature(root_signature);
  list.SetPipelineState(pipeline);
  list.SetComputeRootUnorderedAccessView(0, results.GetGPUVirtualAddress());
  list.Dispatch(kThreads / 64, 1, 1);
  queue.ExecuteAndWait(list).value();
  return ReadbackBuffer(device, queue, results).value();
}

class FirstUse : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() != "vulkan") return;
    if (const std::string why = test::why_no_vulkan(); !why.empty()) {
      if (test::vulkan_is_required()) FAIL() << why;
      GTEST_SKIP() << why;
    }
  }
};

TEST_P(FirstUse, GivesTheBitsOfTheBuild) {
  const Device device = CreateDevice({.Backend = GetParam()}).value();
  const auto built = LoadShaderLibrary(kaamos_shaders_first_use_built());
  ASSERT_TRUE(built.ok()) << built.error().message;
  const auto late = LoadShaderLibrary(kaamos_shaders_first_use());
  ASSERT_TRUE(late.ok()) << late.error().message;
  ASSERT_EQ(late->GetExports().size(), 1u);
  EXPECT_EQ(late->GetExports()[0].Name, "Angles");
  EXPECT_EQ(late->name(), built->name());
  const std::vector<std::byte> expected = run(device, *built);
  EXPECT_NE(expected, std::vector<std::byte>(expected.size()));
  EXPECT_EQ(run(device, *late), expected);
}

INSTANTIATE_TEST_SUITE_P(, FirstUse, ::testing::Values("embree", "vulkan"),
                         [](const auto& tested) { return tested.param; });

TEST(FirstUseOnce, ThreadsThatLoadTheSameLibraryGetOne) {
  std::vector<ShaderLibrary> loaded(4);
  std::vector<std::thread> threads;
  for (ShaderLibrary& library : loaded) {
    threads.emplace_back(
        [&library] { library = LoadShaderLibrary(kaamos_shaders_first_use()).value(); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const ShaderLibrary& library : loaded) EXPECT_EQ(library, loaded[0]);
}

TEST(FirstUseOnce, ChecksAreCompiledFromTheSameSource) {
  std::vector<std::string> said;
  DeviceDesc desc;
  desc.Checked = true;
  desc.OnMessage = [&](const Message& message) { said.push_back(message.Text); };
  const Device device = CreateDevice(desc).value();
  const auto late = LoadShaderLibrary(kaamos_shaders_first_use());
  ASSERT_TRUE(late.ok()) << late.error().message;
  EXPECT_EQ(run(device, *late), run(CreateDevice({}).value(), *late));
  EXPECT_TRUE(said.empty()) << said.front();
}

// In a process of its own, since a library is compiled once.
TEST(FirstUseDeathTest, WithoutACompilerTheErrorSaysSo) {
  EXPECT_EXIT(
      {
        setenv("KAAMOS_CXX", "/no/such/compiler", 1);
        const auto late = LoadShaderLibrary(kaamos_shaders_first_use_other());
        if (late.ok()) std::exit(1);
        std::fputs(late.error().message.c_str(), stderr);
        std::exit(0);
      },
      ::testing::ExitedWithCode(0), "KA2750 .*no/such/compiler");
}

}  // namespace
}  // namespace kaamos::shader_tests
