// SPDX-License-Identifier: MIT
// With vertices on the rasterizer's grid nothing is snapped, and draws and rays see the same
// triangles: what differs in other scenes is the snapping.
#include <gtest/gtest.h>
#include <rtapi/rtapi.h>
#include <shaders/snapped.h>

#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "tests/common/structures.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

using namespace rtapi;

constexpr std::uint32_t kSize = 512;  // pixels

// A closed sheet of small triangles, and before it loose ones, none of which touch in depth.
std::vector<glm::vec3> make_triangles() {
  std::mt19937 random(7);
  const auto on_grid = [&](double low, double high) {
    return static_cast<float>(std::floor(std::uniform_real_distribution(low, high)(random) * 256) /
                              256);
  };
  std::vector<glm::vec3> out;
  constexpr int kCell = 4, kCells = static_cast<int>(kSize) / kCell + 2;
  std::vector<glm::vec3> sheet;
  for (int y = 0; y <= kCells; ++y) {
    for (int x = 0; x <= kCells; ++x) {
      sheet.emplace_back(on_grid(kCell * (x - 1.3), kCell * (x - 0.7)),
                         on_grid(kCell * (y - 1.3), kCell * (y - 0.7)),
                         0.9 + 0.1 * std::uniform_real_distribution(0.0, 1.0)(random));
    }
  }
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      const int a = y * (kCells + 1) + x, c = a + kCells + 1;
      for (const int i : {a, a + 1, c, a + 1, c + 1, c})
        out.push_back(sheet[static_cast<std::size_t>(i)]);
    }
  }
  constexpr int kLoose = 8000;
  for (int i = 0; i < kLoose; ++i) {
    const double x = on_grid(0, kSize), y = on_grid(0, kSize);
    const float z = 0.1f + 0.7f * static_cast<float>(i * 37 % kLoose) / kLoose;
    for (int corner = 0; corner < 3; ++corner) {
      out.emplace_back(on_grid(x - 5, x + 5), on_grid(y - 5, y + 5), z);
    }
  }
  return out;
}

// Tells whether a pixel's center lies exactly on an edge of triangle `id` - 1: then the rasterizer
// goes by its top-left rule, and rays may take either side. All products are exact in double.
bool is_on_edge(const std::vector<glm::vec3>& triangles, std::uint32_t id,
                const glm::dvec2& center) {
  if (id == 0) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 a(triangles[(id - 1) * 3 + k]), b(triangles[(id - 1) * 3 + (k + 1) % 3]);
    if ((b.x - a.x) * (center.y - a.y) == (b.y - a.y) * (center.x - a.x)) return true;
  }
  return false;
}

class SnappedTriangles : public test::OnBackends {};
INSTANTIATE_TEST_SUITE_P(Backends, SnappedTriangles, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

TEST_P(SnappedTriangles, AreTheSameForDrawsAndRays) {
  DeviceDesc device_desc;
  device_desc.Backend = GetParam();
  const Device device = test::device_for(device_desc);
  CommandQueue queue = device.CreateCommandQueue().value();
  const std::vector<glm::vec3> triangles = make_triangles();
  const Buffer vertices = CreateUploadBuffer(device, triangles, "triangles").value();
  RaytracingGeometryDesc geometry;
  geometry.Flags = RaytracingGeometryFlags::kOpaque;
  geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  geometry.Triangles.VertexCount = static_cast<std::uint32_t>(triangles.size());
  geometry.Triangles.VertexBuffer = {vertices.GetGPUVirtualAddress(), sizeof(glm::vec3)};
  const Buffer bottom = test::build_bottom_level(device, queue, {geometry});
  const Buffer top = test::build_top_level(
      device, queue,
      {RaytracingInstanceDesc{.AccelerationStructure = bottom.GetGPUVirtualAddress()}});

  const RootSignature signature = device
                                      .CreateRootSignature(
                                          "RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT), "
                                          "RootConstants(num32BitConstants=1, b0), SRV(t0), "
                                          "DescriptorTable(UAV(u0))")
                                      .value();
  TextureDesc picture;
  picture.Width = picture.Height = kSize;
  picture.Format = Format::kR32Uint;
  picture.Flags = ResourceFlags::kAllowRenderTarget;
  picture.InitialState = ResourceStates::kRenderTarget;
  const Texture drawn = device.CreateTexture(picture).value();
  picture.Flags = ResourceFlags::kAllowUnorderedAccess;
  picture.InitialState = ResourceStates::kUnorderedAccess;
  const Texture traced = device.CreateTexture(picture).value();
  picture.Format = Format::kD32Float;
  picture.Flags = ResourceFlags::kAllowDepthStencil;
  picture.InitialState = ResourceStates::kDepthWrite;
  const Texture depth = device.CreateTexture(picture).value();
  const auto heap = [&](DescriptorHeapType type, DescriptorHeapFlags flags) {
    return device.CreateDescriptorHeap({.Type = type, .NumDescriptors = 1, .Flags = flags}).value();
  };
  const DescriptorHeap rtvs = heap(DescriptorHeapType::kRtv, DescriptorHeapFlags::kNone);
  const DescriptorHeap dsvs = heap(DescriptorHeapType::kDsv, DescriptorHeapFlags::kNone);
  const DescriptorHeap views =
      heap(DescriptorHeapType::kCbvSrvUav, DescriptorHeapFlags::kShaderVisible);
  const CpuDescriptorHandle target = rtvs.GetCPUDescriptorHandle(0);
  const CpuDescriptorHandle depth_target = dsvs.GetCPUDescriptorHandle(0);
  device.CreateRenderTargetView(drawn, target).value();
  device.CreateDepthStencilView(depth, depth_target).value();
  device.CreateUnorderedAccessView(traced, views.GetCPUDescriptorHandle(0)).value();

  const ShaderLibrary library = LoadShaderLibrary(kaamos_shaders_snapped()).value();
  GraphicsPipelineStateDesc graphics;
  graphics.pRootSignature = signature;
  graphics.VS = {library, "GridVertex"};
  graphics.PS = {library, "DrawnTriangle"};
  graphics.RasterizerState.CullMode = CullMode::kNone;
  graphics.InputLayout = {{.SemanticName = "POSITION", .Format = Format::kR32G32B32Float}};
  graphics.RTVFormats = {Format::kR32Uint};
  graphics.DSVFormat = Format::kD32Float;
  ComputePipelineStateDesc compute;
  compute.pRootSignature = signature;
  compute.CS = library;
  compute.EntryPoint = "TraceTriangles";

  CommandList list = device.CreateCommandList().value();
  const float nothing[4] = {};
  const float size = kSize;
  list.ClearRenderTargetView(target, nothing);
  list.ClearDepthStencilView(depth_target, ClearFlags::kDepth, 1, 0);
  list.OMSetRenderTargets(1, &target, false, &depth_target);
  list.RSSetViewports(Viewport{0, 0, size, size, 0, 1});
  list.RSSetScissorRects(Rect{0, 0, kSize, kSize});
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  list.IASetVertexBuffers(
      0, VertexBufferView{vertices.GetGPUVirtualAddress(),
                          static_cast<std::uint32_t>(vertices.size()), sizeof(glm::vec3)});
  list.SetDescriptorHeaps({views});
  list.SetGraphicsRootSignature(signature);
  list.SetGraphicsRoot32BitConstants(0, size);
  list.SetPipelineState(device.CreateGraphicsPipelineState(graphics).value());
  list.DrawInstanced(static_cast<std::uint32_t>(triangles.size()), 1, 0, 0);
  list.SetComputeRootSignature(signature);
  list.SetComputeRoot32BitConstants(0, size);
  list.SetComputeRootShaderResourceView(1, top.GetGPUVirtualAddress());
  list.SetComputeRootDescriptorTable(2, views.GetGPUDescriptorHandleForHeapStart());
  list.SetPipelineState(device.CreateComputePipelineState(compute).value());
  list.Dispatch(kSize / 8, kSize / 8, 1);
  queue.ExecuteAndWait(list).value();

  const auto a = ReadbackTexture(device, queue, drawn, 0).value();
  const auto b = ReadbackTexture(device, queue, traced, 0).value();
  std::uint32_t different = 0, ties = 0, loose = 0;
  for (std::size_t i = 0; i < std::size_t{kSize} * kSize; ++i) {
    std::uint32_t seen_a, seen_b;
    std::memcpy(&seen_a, a.data() + 4 * i, 4);
    std::memcpy(&seen_b, b.data() + 4 * i, 4);
    ASSERT_NE(seen_b, 0u) << "the sheet is closed";
    loose += seen_b > (triangles.size() - 3 * 8000) / 3;
    if (seen_a == seen_b) continue;
    const glm::dvec2 center(static_cast<double>(i % kSize) + 0.5,
                            static_cast<double>(i / kSize) + 0.5);
    ++(is_on_edge(triangles, seen_a, center) || is_on_edge(triangles, seen_b, center) ? ties
                                                                                      : different);
  }
  EXPECT_GT(loose, kSize * kSize / 8);
  EXPECT_LE(ties, 16u);
  EXPECT_EQ(different, 0u) << "of " << kSize * kSize << " pixels: more than 1e-6";
}

}  // namespace
}  // namespace kaamos::effects
