// SPDX-License-Identifier: MIT
#include "canvas.h"

#include <gtest/gtest.h>
#include <shaders/draws.h>

#include <cstring>

namespace kaamos::draws {

using namespace rtapi;

Canvas::Canvas(const std::string& backend, Format format, uint32_t max_threads)
    : format_(format), texel_bytes_(GetFormatInfo(format).bytes) {
  DeviceDesc desc;
  desc.Backend = backend;
  desc.Threads = max_threads;
  desc.OnMessage = [](const Message& m) { ADD_FAILURE() << m.Text; };
  device = CreateDevice(desc).value();
  queue = device.CreateCommandQueue().value();
  root_signature =
      device
          .CreateRootSignature(
              "RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT), RootConstants(num32BitConstants=4, "
              "b0), DescriptorTable(SRV(t0)), SRV(t1), UAV(u0), StaticSampler(s0, "
              "filter=FILTER_MIN_MAG_MIP_LINEAR)")
          .value();
  views =
      device
          .CreateDescriptorHeap({.NumDescriptors = 1, .Flags = DescriptorHeapFlags::kShaderVisible})
          .value();
  counter = device
                .CreateBuffer({.SizeInBytes = 8,
                               .Flags = ResourceFlags::kAllowUnorderedAccess,
                               .InitialState = ResourceStates::kUnorderedAccess,
                               .Name = "counter"})
                .value();
  target = device
               .CreateTexture({.Width = kSize,
                               .Height = kSize,
                               .Format = format,
                               .Flags = ResourceFlags::kAllowRenderTarget,
                               .InitialState = ResourceStates::kRenderTarget,
                               .Name = "target"})
               .value();
  depth_buffer = device
                     .CreateTexture({.Width = kSize,
                                     .Height = kSize,
                                     .Format = Format::kR32Typeless,
                                     .Flags = ResourceFlags::kAllowDepthStencil,
                                     .InitialState = ResourceStates::kDepthWrite,
                                     .Name = "depth"})
                     .value();
  rtvs =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1}).value();
  dsvs =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kDsv, .NumDescriptors = 1}).value();
  device.CreateRenderTargetView(target, rtvs.GetCPUDescriptorHandle(0)).value();
  device.CreateDepthStencilView(depth_buffer, dsvs.GetCPUDescriptorHandle(0)).value();
}

GraphicsPipelineStateDesc Canvas::desc(const std::string& vertex, const std::string& pixel) const {
  const ShaderLibrary library = LoadShaderLibrary(kaamos_shaders_draws()).value();
  GraphicsPipelineStateDesc desc;
  desc.pRootSignature = root_signature;
  desc.VS = {library, vertex};
  if (!pixel.empty()) desc.PS = {library, pixel};
  desc.RasterizerState.CullMode = CullMode::kNone;
  desc.RTVFormats = {format_};
  desc.DSVFormat = Format::kD32Float;
  desc.Name = vertex + " and " + pixel;
  return desc;
}

PipelineState Canvas::make(const GraphicsPipelineStateDesc& desc) const {
  return device.CreateGraphicsPipelineState(desc).value();
}

void Canvas::use(CommandList& list, const PipelineState& pipeline, Tint tint) {
  list.SetPipelineState(pipeline);
  list.SetGraphicsRoot32BitConstants(0, tint);
}

void Canvas::run(const std::function<void(CommandList&)>& record, float clear_depth) {
  CommandList commands = list(record, clear_depth);
  queue.ExecuteAndWait(commands).value();
  read_back();
}

void Canvas::read_back() {
  color_ = ReadbackTexture(device, queue, target, 0).value();
  depth_ = ReadbackTexture(device, queue, depth_buffer, 0).value();
}

CommandList Canvas::list(const std::function<void(CommandList&)>& record, float clear_depth) {
  CommandList list = device.CreateCommandList().value();
  const CpuDescriptorHandle rtv = rtvs.GetCPUDescriptorHandle(0);
  const CpuDescriptorHandle dsv = dsvs.GetCPUDescriptorHandle(0);
  const float black[4] = {0, 0, 0, 0};
  list.ClearRenderTargetView(rtv, black);
  list.ClearDepthStencilView(dsv, ClearFlags::kDepth, clear_depth, 0);
  list.SetDescriptorHeaps({views});
  list.SetGraphicsRootSignature(root_signature);
  list.SetGraphicsRootDescriptorTable(1, views.GetGPUDescriptorHandle(0));
  list.SetGraphicsRootUnorderedAccessView(3, counter.GetGPUVirtualAddress());
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  list.RSSetViewports(Viewport{0, 0, kSize, kSize, 0, 1});
  list.RSSetScissorRects(Rect{0, 0, kSize, kSize});
  list.OMSetRenderTargets(1, &rtv, false, &dsv);
  record(list);
  list.Close().value();
  return list;
}

float Canvas::depth(uint32_t x, uint32_t y) const {
  float value;
  std::memcpy(&value, depth_.data() + (size_t{y} * kSize + x) * sizeof value, sizeof value);
  return value;
}

}  // namespace kaamos::draws
