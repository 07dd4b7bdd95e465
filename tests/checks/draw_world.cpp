// SPDX-License-Identifier: MIT
#include "tests/checks/draw_world.h"

#include <shaders/draw_mistakes.h>

namespace kaamos::checks::test {

using namespace rtapi;

void DrawWorld::SetUp() {
  DeviceDesc desc;
  desc.Backend = "embree";
  desc.Checked = true;
  desc.OnMessage = [this](const Message& message) { messages_.push_back(message); };
  device_ = CreateDevice(desc).value();
  queue_ = device_.CreateCommandQueue().value();
  root_ = device_
              .CreateRootSignature(
                  "RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT), RootConstants(num32BitConstants="
                  "4, b0), DescriptorTable(SRV(t0)), UAV(u0)")
              .value();
  color_ = texture("color", Format::kR32G32B32A32Float, ResourceFlags::kAllowRenderTarget,
                   ResourceStates::kRenderTarget);
  small_ = texture("small", Format::kR32G32B32A32Float, ResourceFlags::kAllowRenderTarget,
                   ResourceStates::kRenderTarget, 8);
  bytes_ = texture("bytes", Format::kR8G8B8A8Unorm, ResourceFlags::kAllowRenderTarget,
                   ResourceStates::kRenderTarget);
  depth_ = texture("depth", Format::kR32Typeless, ResourceFlags::kAllowDepthStencil,
                   ResourceStates::kDepthWrite);
  image_ = texture("image", Format::kR32G32B32A32Float, ResourceFlags::kAllowRenderTarget,
                   ResourceStates::kPixelShaderResource);
  const auto heap = [&](DescriptorHeapType type, uint32_t count, DescriptorHeapFlags flags) {
    return device_.CreateDescriptorHeap({.Type = type, .NumDescriptors = count, .Flags = flags})
        .value();
  };
  rtvs_ = heap(DescriptorHeapType::kRtv, 3, DescriptorHeapFlags::kNone);
  dsvs_ = heap(DescriptorHeapType::kDsv, 2, DescriptorHeapFlags::kNone);
  views_ = heap(DescriptorHeapType::kCbvSrvUav, 3, DescriptorHeapFlags::kShaderVisible);
  device_.CreateRenderTargetView(color_, rtvs_.GetCPUDescriptorHandle(0)).value();
  device_.CreateRenderTargetView(small_, rtvs_.GetCPUDescriptorHandle(1)).value();
  device_.CreateRenderTargetView(bytes_, rtvs_.GetCPUDescriptorHandle(2)).value();
  device_.CreateDepthStencilView(depth_, dsvs_.GetCPUDescriptorHandle(0)).value();
  DepthStencilViewDesc read_only;
  read_only.Flags = DsvFlags::kReadOnlyDepth;
  device_.CreateDepthStencilView(depth_, read_only, dsvs_.GetCPUDescriptorHandle(1)).value();
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kTexture2D;
  view.Format = Format::kR32G32B32A32Float;
  view.Texture2D.MipLevels = 1;
  device_.CreateShaderResourceView(image_, view, views_.GetCPUDescriptorHandle(0)).value();
  device_.CreateShaderResourceView(color_, view, views_.GetCPUDescriptorHandle(1)).value();
  view.Format = Format::kR32Float;
  device_.CreateShaderResourceView(depth_, view, views_.GetCPUDescriptorHandle(2)).value();
  stored_ = device_
                .CreateBuffer({.SizeInBytes = kSize * kSize * 4,
                               .Flags = ResourceFlags::kAllowUnorderedAccess,
                               .InitialState = ResourceStates::kUnorderedAccess,
                               .Name = "stored"})
                .value();
}

Texture DrawWorld::texture(const std::string& name, Format format, ResourceFlags flags,
                           ResourceStates state, uint32_t size, const ClearValue& clear) {
  TextureDesc desc;
  desc.Width = size;
  desc.Height = size;
  desc.Format = format;
  desc.Flags = flags;
  desc.InitialState = state;
  desc.Name = name;
  desc.OptimizedClearValue = clear;
  return device_.CreateTexture(desc).value();
}

GraphicsPipelineStateDesc DrawWorld::desc(const std::string& pixel,
                                          const std::string& vertex) const {
  const ShaderLibrary library = LoadShaderLibrary(kaamos_shaders_draw_mistakes()).value();
  GraphicsPipelineStateDesc desc;
  desc.pRootSignature = root_;
  desc.VS = {library, vertex};
  desc.PS = {library, pixel};
  desc.RasterizerState.CullMode = CullMode::kNone;
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kLess;
  desc.RTVFormats = {Format::kR32G32B32A32Float};
  desc.DSVFormat = Format::kD32Float;
  if (vertex != "WholeTarget") {
    desc.InputLayout = {
        {.SemanticName = "POSITION", .Format = Format::kR32G32B32A32Float, .InputSlot = 1}};
  }
  desc.Name = "plain";
  return desc;
}

void DrawWorld::set_all(CommandList& list) {
  list.SetDescriptorHeaps({views_});
  list.SetGraphicsRootSignature(root_);
  list.SetGraphicsRootDescriptorTable(1, views_.GetGPUDescriptorHandle(0));
  list.SetGraphicsRootUnorderedAccessView(2, stored_.GetGPUVirtualAddress());
  set_tint(list, 1);
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  list.RSSetViewports(Viewport{0, 0, kSize, kSize, 0, 1});
  list.RSSetScissorRects(Rect{0, 0, kSize, kSize});
}

void DrawWorld::set_tint(CommandList& list, float x, float y, float z, float w) {
  const float values[4] = {x, y, z, w};
  list.SetGraphicsRoot32BitConstants(0, 4, values, 0);
}

CommandList DrawWorld::begin(float clear_depth) {
  CommandList list = device_.CreateCommandList().value();
  const float black[4] = {0, 0, 0, 0};
  list.ClearRenderTargetView(rtvs_.GetCPUDescriptorHandle(0), black);
  list.ClearDepthStencilView(dsvs_.GetCPUDescriptorHandle(0), ClearFlags::kDepth, clear_depth, 0);
  set_all(list);
  bind(list, 0);
  return list;
}

void DrawWorld::bind(CommandList& list, uint32_t rtv, int dsv) {
  const CpuDescriptorHandle color = rtvs_.GetCPUDescriptorHandle(rtv);
  const CpuDescriptorHandle depth =
      dsvs_.GetCPUDescriptorHandle(dsv < 0 ? 0 : static_cast<uint32_t>(dsv));
  list.OMSetRenderTargets(1, &color, false, dsv < 0 ? nullptr : &depth);
}

void DrawWorld::draw(CommandList& list, const GraphicsPipelineStateDesc& desc) {
  list.SetPipelineState(make(desc));
  list.DrawInstanced(3, 1, 0, 0);
}

void DrawWorld::run(CommandList& list) {
  list.Close().value();
  queue_.ExecuteAndWait(list).value();
}

std::vector<std::string> DrawWorld::told() {
  std::vector<std::string> out;
  for (const Message& message : messages_) {
    if (message.Text.find("KA0424") == std::string::npos) out.push_back(message.Text);
  }
  messages_.clear();
  return out;
}

void DrawWorld::expect_one(const std::string& id, const std::vector<std::string>& parts) {
  const std::vector<std::string> all = told();
  ASSERT_EQ(all.size(), 1u) << ::testing::PrintToString(all);
  EXPECT_EQ(all[0].substr(0, id.size()), id) << all[0];
  size_t at = 0;
  for (const std::string& part : parts) {
    const size_t found = all[0].find(part, at);
    ASSERT_NE(found, std::string::npos) << "no \"" << part << "\" in: " << all[0];
    at = found + part.size();
  }
}

void DrawWorld::expect_none() {
  const std::vector<std::string> all = told();
  EXPECT_TRUE(all.empty()) << ::testing::PrintToString(all);
}

}  // namespace kaamos::checks::test
