// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rtapi/rtapi.h>
#include <rtapi/shader_compiler.h>
#include <rtapi/upload.h>
#include <shaders/positions.h>

#include <cstring>
#include <string>
#include <vector>

#include "tests/common/structures.h"
#include "tests/vulkan/support.h"

namespace kaamos::checks {
namespace {

using namespace rtapi;
using BuildFlags = RaytracingAccelerationStructureBuildFlags;

ShaderLibrary interpreted_library() {
  ShaderCompileOptions options;
  options.File = KAAMOS_POSITIONS_HLSL;
  options.Target = "lib_6_10";
  options.Experimental = true;
  options.Interpret = true;
  options.Spirv = false;
  const ShaderCompilation out = CompileShaderLibrary(options);
  out.Status.value();
  return out.Library;
}

// Compute shaders of shader model 6.10.
class CheckedPositions : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::string executor = GetParam();
    if (executor == "vulkan") KAAMOS_NEED_VULKAN();
    DeviceDesc desc;
    desc.Backend = executor == "vulkan" ? "vulkan" : "embree";
    desc.ShaderModel = ShaderModel::k6_10;
    desc.Checked = true;
    desc.OnMessage = [this](const Message& message) { messages_.push_back(message.Text); };
    device_ = CreateDevice(desc).value();
    queue_ = device_.CreateCommandQueue().value();
    library_ = executor == "interpreted" ? interpreted_library()
                                         : LoadShaderLibrary(kaamos_shaders_positions()).value();
  }

  // Runs the kernel over a triangle around (0, 0, 0); returns the words that it wrote.
  std::vector<uint32_t> run(const char* kernel, BuildFlags flags) {
    const std::vector<float> corners = {-1, -1, 0, 0.25f, 2, 0.5f, 1, -1, 0};
    const Buffer vertices = CreateUploadBuffer(device_, corners, "corners").value();
    RaytracingGeometryDesc triangle;
    triangle.Triangles.VertexFormat = Format::kR32G32B32Float;
    triangle.Triangles.VertexCount = 3;
    triangle.Triangles.VertexBuffer = {vertices.GetGPUVirtualAddress(), 12};
    const std::vector<RaytracingGeometryDesc> geometries = {triangle};
    const Buffer bottom = BuildBottomLevel(device_, queue_, geometries, "triangle", flags).value();
    RaytracingInstanceDesc instance;
    instance.AccelerationStructure = bottom.GetGPUVirtualAddress();
    const Buffer top = kaamos::test::build_top_level(device_, queue_, {instance});
    const Buffer result = device_
                              .CreateBuffer({.SizeInBytes = 16,
                                             .Flags = ResourceFlags::kAllowUnorderedAccess,
                                             .InitialState = ResourceStates::kUnorderedAccess,
                                             .Name = "result"})
                              .value();
    const RootSignature root = device_.CreateRootSignature("SRV(t0), UAV(u0)").value();
    const PipelineState pipeline =
        device_
            .CreateComputePipelineState(
                {.pRootSignature = root, .CS = library_, .EntryPoint = kernel})
            .value();
    CommandList list = device_.CreateCommandList().value();
    list.SetComputeRootSignature(root);
    list.SetPipelineState(pipeline);
    list.SetComputeRootShaderResourceView(0, top.GetGPUVirtualAddress());
    list.SetComputeRootUnorderedAccessView(1, result.GetGPUVirtualAddress());
    list.Dispatch(1, 1, 1);
    messages_.clear();
    queue_.ExecuteAndWait(list).value();
    const auto bytes = ReadbackBuffer(device_, queue_, result).value();
    std::vector<uint32_t> words(4);
    std::memcpy(words.data(), bytes.data(), 16);
    return words;
  }

  // Exactly one message with this id, which has both parts.
  void expect(const std::string& id, const std::string& first, const std::string& second) {
    std::string found;
    for (const std::string& message : messages_) {
      if (message.starts_with(id)) found = message;
      EXPECT_TRUE(message.starts_with(id)) << message;
    }
    EXPECT_NE(found.find(first), std::string::npos) << found;
    EXPECT_NE(found.find(second), std::string::npos) << found;
  }

  Device device_;
  CommandQueue queue_;
  ShaderLibrary library_;
  std::vector<std::string> messages_;
};

TEST_P(CheckedPositions, OfABottomLevelThatAllowsIt) {
  const auto words = run("Hit", BuildFlags::kAllowDataAccess);
  EXPECT_EQ(words, (std::vector<uint32_t>{0x3E800000, 0x40000000, 0x3F000000, 0}));
  for (const std::string& message : messages_) ADD_FAILURE() << message;
}

TEST_P(CheckedPositions, OfABottomLevelThatDoesNot) {
  run("Hit", BuildFlags::kNone);
  expect("KA0414", "positions.hlsl:18",
         "geometry 0, primitive 0, but the bottom level was built without kAllowDataAccess");
}

TEST_P(CheckedPositions, OfAMiss) {
  EXPECT_EQ(run("Missed", BuildFlags::kAllowDataAccess), std::vector<uint32_t>(4));
  expect("KA0413", "positions.hlsl:18", "is not the hit of a triangle; it reads 0");
}

TEST_P(CheckedPositions, ABreakWithoutADebugger) {
  EXPECT_EQ(run("Break", BuildFlags::kNone)[0], 2u);
  expect("KA0415", "positions.hlsl:34", "no debugger is attached");
}

INSTANTIATE_TEST_SUITE_P(Executors, CheckedPositions,
                         testing::Values("native", "interpreted", "vulkan"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace kaamos::checks
