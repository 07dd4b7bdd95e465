// SPDX-License-Identifier: MIT
//
// Replays that write textures: afterwards a texture holds the result of exactly one dispatch.
#include <gtest/gtest.h>
#include <rtapi/explain.h>
#include <rtapi/rtapi.h>
#include <shaders/accumulate.h>

#include <cstring>

#include "tests/explain/scene.h"

using namespace rtapi;

namespace kaamos::explain_test {
namespace {

KAAMOS_EXPLAIN_SUITE(ExplainTextures);

std::vector<float> floats_of(const Device& device, CommandQueue& queue, const Texture& texture) {
  const auto bytes = ReadbackTexture(device, queue, texture, 0).value();
  std::vector<float> out(bytes.size() / sizeof(float));
  std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

TEST_P(ExplainTextures, AReplayLeavesTexturesAsTheyAre) {
  const auto picture = [&](Format format, const char* name) {
    TextureDesc desc;
    desc.Width = 2;
    desc.Height = 1;
    desc.Format = format;
    desc.Flags = ResourceFlags::kAllowUnorderedAccess;
    desc.Name = name;
    const Texture texture = device_.CreateTexture(desc).value();
    const std::vector<std::byte> zeros(2 * (format == Format::kR32Float ? 4 : 16));
    UploadTexture(device_, queue_, texture, 0, zeros).value();
    return texture;
  };
  const Texture pictures[3] = {picture(Format::kR32Float, "total"),
                               picture(Format::kR32G32B32A32Float, "totals 0"),
                               picture(Format::kR32G32B32A32Float, "totals 1")};
  const DescriptorHeap heap =
      device_
          .CreateDescriptorHeap(
              {.NumDescriptors = 3, .Flags = DescriptorHeapFlags::kShaderVisible, .Name = "views"})
          .value();
  for (uint32_t i = 0; i < 3; ++i) {
    device_.CreateUnorderedAccessView(pictures[i], heap.GetCPUDescriptorHandle(i)).value();
  }
  const RootSignature root =
      device_.CreateRootSignature("DescriptorTable(UAV(u0, numDescriptors=3))").value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_accumulate()).value()});
  desc.Add(RaytracingShaderConfig{4, 8});
  desc.Add(RaytracingPipelineConfig{1});
  desc.Add(GlobalRootSignature{root});
  const StateObject pipeline = device_.CreateStateObject(desc).value();
  ShaderTable table(pipeline, "ray generation");
  table.AddRecord("Accumulate").value();
  table.Build(device_).value();
  DispatchRaysDesc dispatch;
  dispatch.RayGenerationShaderRecord = table.GetRecord(0);
  dispatch.Width = 2;

  CommandList list = device_.CreateCommandList().value();
  list.SetDescriptorHeaps({heap});
  list.SetComputeRootSignature(root);
  list.SetComputeRootDescriptorTable(0, heap.GetGPUDescriptorHandle(0));
  list.SetPipelineState1(pipeline);
  list.DispatchRays(dispatch);
  ASSERT_TRUE(ExplainPixel(queue_, list, {.X = 1}).ok());
  EXPECT_EQ(floats_of(device_, queue_, pictures[0]), (std::vector<float>{1, 1}));
  EXPECT_EQ(floats_of(device_, queue_, pictures[1]), (std::vector<float>{1, 2, 3, 4, 0, 0, 0, 0}));
  EXPECT_EQ(floats_of(device_, queue_, pictures[2]), (std::vector<float>{0, 0, 0, 0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace kaamos::explain_test
