// SPDX-License-Identifier: MIT
//
// Rules of target views: sizes, read-only depth, when descriptors are read, mips and slices.
#include <shaders/ras_output.h>

#include "tests/conformance/ras_clears.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

void common_area(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, 64);
  Screen small(t, {}, Format::kD32Float, 32);
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Tint");
  desc.DSVFormat = Format::kD32Float;
  desc.DepthStencilState.DepthEnable = true;
  const PipelineState pipeline = screen.make(desc);
  const CpuDescriptorHandle target = screen.rtv(), depth = small.dsv();
  screen.run([&](CommandList& list) {
    list.ClearDepthStencilView(depth, ClearFlags::kDepth, 1, 0);
    list.OMSetRenderTargets(1, &target, false, &depth);
    screen.cover(list, pipeline);
  });
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    return (screen.texel<float>(x, y) != 0) != (x < 32 && y < 32);
  }),
          0u);
  small.clears = false;
  small.run([](CommandList&) {});
  t.equal("depths that differ",
          small.count([&](uint32_t x, uint32_t y) { return small.depth(x, y) != 0.5f; }), 0u);
}

void read_only_depth(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kD32Float, 32);
  screen.library = kaamos_shaders_ras_output();
  const PipelineState before = screen.make("Pass", "");
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "BesideDepth");
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kLessEqual;
  const PipelineState beside = screen.make(desc);
  const DescriptorHeap heap =
      t.device()
          .CreateDescriptorHeap({.Type = DescriptorHeapType::kDsv, .NumDescriptors = 1})
          .value();
  DepthStencilViewDesc view;
  view.Format = Format::kD32Float;
  view.ViewDimension = DsvDimension::kTexture2D;
  view.Flags = DsvFlags::kReadOnlyDepth;
  t.device()
      .CreateDepthStencilView(screen.depth_texture, view, heap.GetCPUDescriptorHandle(0))
      .value();
  ShaderResourceViewDesc srv;
  srv.Format = Format::kR32Float;
  srv.ViewDimension = SrvDimension::kTexture2D;
  t.device()
      .CreateShaderResourceView(screen.depth_texture, srv, screen.views.GetCPUDescriptorHandle(0))
      .value();
  // In front: a slanted triangle. The others fail against it.
  std::vector<Corner> front = screen.rectangle(0, 0, 32, 32, 0.25f);
  front[1].position[2] = front[4].position[2] = 0.375f;
  const ResourceStates both = ResourceStates::kDepthRead | ResourceStates::kPixelShaderResource;
  screen.run([&](CommandList& list) {
    screen.draw(list, before, front);
    list.ResourceBarrier(
        ResourceBarrier::Transition(screen.depth_texture, ResourceStates::kDepthWrite, both));
    const CpuDescriptorHandle target = screen.rtv(), depth = heap.GetCPUDescriptorHandle(0);
    list.OMSetRenderTargets(1, &target, false, &depth);
    screen.draw(list, beside, front);
    screen.draw(list, beside, screen.rectangle(0, 0, 16, 32, 0.125f));
    screen.draw(list, beside, screen.rectangle(0, 0, 32, 16, 0.75f));
    list.ResourceBarrier(
        ResourceBarrier::Transition(screen.depth_texture, both, ResourceStates::kDepthWrite));
  });
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    if (screen.texel<float>(x, y, 3) == 0) return true;
    const auto stored = screen.texel<float>(x, y, 0);
    const auto own = screen.texel<float>(x, y, 1);
    return stored != screen.depth(x, y) || own != (x < 16 ? 0.125f : stored);
  }),
          0u);
}

void descriptors_are_read_at_once(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, 8);
  TextureDesc desc = screen.colors[0].GetDesc();
  desc.Name = "another";
  const Texture other = t.device().CreateTexture(desc).value();
  const PipelineState pipeline = screen.make("Whole", "Tint");
  const auto aim = [&](const Texture& texture) {
    t.device().CreateRenderTargetView(texture, screen.rtv()).value();
  };
  const std::array<float, 4> nine = {9, 9, 9, 9};
  screen.run([&](CommandList& list) {
    aim(other);
    screen.cover(list, pipeline);
    list.ClearRenderTargetView(screen.rtv(), nine.data());
    aim(screen.colors[0]);
  });
  t.equal("drawn to", screen.covered(), 64u);
  const auto texels = ReadbackTexture(t.device(), t.queue(), other, 0).value();
  float found;
  std::memcpy(&found, texels.data() + 20, sizeof found);
  t.equal("cleared", found, 9.0f);
}

// The first texel of each subresource, slice after slice.
std::vector<float> firsts(Context& t, const Texture& texture) {
  std::vector<float> out;
  for (uint32_t i = 0; i < texture.subresource_count(); ++i) {
    const auto texels = ReadbackTexture(t.device(), t.queue(), texture, i).value();
    out.emplace_back();
    std::memcpy(&out.back(), texels.data(), sizeof(float));
  }
  return out;
}

void mips_and_slices(Context& t) {
  TextureDesc desc = {.Width = 16, .Height = 16, .DepthOrArraySize = 6, .MipLevels = 3};
  desc.Format = Format::kR32Float;
  desc.Flags = ResourceFlags::kAllowRenderTarget;
  desc.InitialState = ResourceStates::kRenderTarget;
  const Texture cube = t.device().CreateTexture(desc).value();
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, 4);
  const PipelineState pipeline = screen.make("Whole", "Tint");
  RenderTargetViewDesc view;
  view.ViewDimension = RtvDimension::kTexture2DArray;
  view.Texture2DArray = {2, 3, 1};
  t.device().CreateRenderTargetView(cube, view, screen.rtv(1)).value();
  const CpuDescriptorHandle target = screen.rtv(1);
  screen.run([&](CommandList& list) {
    list.OMSetRenderTargets(1, &target);
    screen.cover(list, pipeline, {.tint = {5, 0, 0, 0}});
  });
  std::vector<float> expected(18, 0.0f);
  expected[3 * 3 + 2] = 5;
  t.equal("mip 2 of slice 3", firsts(t, cube), expected);
  // Without a description: mip 0 of all slices.
  t.device().CreateRenderTargetView(cube, screen.rtv(1)).value();
  const std::array<float, 4> seven = {7, 7, 7, 7};
  screen.run([&](CommandList& list) { list.ClearRenderTargetView(target, seven.data()); });
  for (size_t slice = 0; slice < 6; ++slice) expected[slice * 3] = 7;
  t.equal("without a description", firsts(t, cube), expected);
  desc.Format = Format::kR32Typeless;
  const Texture typeless = t.device().CreateTexture(desc).value();
  t.refused("typeless", t.device().CreateRenderTargetView(typeless, screen.rtv(1)), "KA0730");
  view.Texture2DArray = {3, 0, 1};
  t.refused("mip 3", t.device().CreateRenderTargetView(cube, view, screen.rtv(1)), "KA0730");
  view.Texture2DArray = {0, 6, 1};
  t.refused("slice 6", t.device().CreateRenderTargetView(cube, view, screen.rtv(1)), "KA0730");
}

}  // namespace

std::vector<RuleTest> ras_view_tests() {
  return {{"RAS-129", common_area, "*"},
          {"RAS-130", read_only_depth, "*"},
          {"RAS-131", descriptors_are_read_at_once},
          {"RAS-132", mips_and_slices}};
}

}  // namespace kaamos::conformance
