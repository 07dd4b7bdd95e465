// SPDX-License-Identifier: MIT
//
// Replays that write textures: afterwards a texture holds the result of exactly one dispatch. And
// replays that read block-compressed ones.
#include <gtest/gtest.h>
#include <rtapi/explain.h>
#include <rtapi/rtapi.h>
#include <shaders/accumulate.h>
#include <shaders/blocks.h>

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

// The replay reads decoded texels, wherever the dispatch itself runs.
TEST_P(ExplainTextures, AReplayReadsBlocks) {
  TextureDesc texture_desc;
  texture_desc.Width = 6;
  texture_desc.Height = 5;
  texture_desc.Format = Format::kBC1Unorm;
  const Texture texture = device_.CreateTexture(texture_desc).value();
  std::vector<std::byte> data(size_t{2} * 2 * 8);
  data[8 + 1] = data[8 + 3] = std::byte{0xF8};  // the second block is red
  UploadTexture(device_, queue_, texture, 0, data).value();
  const DescriptorHeap heap =
      device_
          .CreateDescriptorHeap(
              {.NumDescriptors = 1, .Flags = DescriptorHeapFlags::kShaderVisible, .Name = "views"})
          .value();
  device_.CreateShaderResourceView(texture, heap.GetCPUDescriptorHandle(0)).value();
  const RootSignature root = device_.CreateRootSignature("DescriptorTable(SRV(t0))").value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_blocks()).value()});
  desc.Add(RaytracingShaderConfig{16, 8});
  desc.Add(RaytracingPipelineConfig{1});
  desc.Add(GlobalRootSignature{root});
  const StateObject pipeline = device_.CreateStateObject(desc).value();
  ShaderTable rays(pipeline, "ray generation"), callables(pipeline, "callables");
  rays.AddRecord("ReadBlocks").value();
  callables.AddRecord("Show").value();
  rays.Build(device_).value();
  callables.Build(device_).value();
  DispatchRaysDesc dispatch;
  dispatch.RayGenerationShaderRecord = rays.GetRecord(0);
  dispatch.CallableShaderTable = callables.GetTable();
  dispatch.Width = 7;

  const auto shown = [&](uint32_t x) {
    CommandList list = device_.CreateCommandList().value();
    list.SetDescriptorHeaps({heap});
    list.SetComputeRootSignature(root);
    list.SetComputeRootDescriptorTable(0, heap.GetGPUDescriptorHandle(0));
    list.SetPipelineState1(pipeline);
    list.DispatchRays(dispatch);
    return ToText(ExplainPixel(queue_, list, {.X = x}).value());
  };
  EXPECT_NE(shown(3).find("color = 0 0 0 1"), std::string::npos) << shown(3);
  EXPECT_NE(shown(5).find("color = 1 0 0 1"), std::string::npos) << shown(5);
  EXPECT_NE(shown(6).find("color = 0 0 0 0"), std::string::npos) << shown(6);
}

}  // namespace
}  // namespace kaamos::explain_test
