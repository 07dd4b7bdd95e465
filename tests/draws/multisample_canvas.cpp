// SPDX-License-Identifier: MIT
#include "multisample_canvas.h"

#include <shaders/multisample.h>

#include <cstring>

namespace kaamos::draws {

using namespace rtapi;

namespace {

constexpr uint32_t kOutputBytes = 16 * 16 * 8 * 16;

ShaderLibrary library() {
  return LoadShaderLibrary(kaamos_shaders_multisample()).value();
}

void transition(CommandList& list, const Texture& texture, ResourceStates before,
                ResourceStates after) {
  list.ResourceBarrier(ResourceBarrier::Transition(texture, before, after));
}

}  // namespace

std::vector<SamplePlace> standard_pattern(uint32_t count) {
  switch (count) {
    case 2:
      return {{4, 4}, {-4, -4}};
    case 4:
      return {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
    case 8:
      return {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
    default:
      return {{0, 0}};
  }
}

MultisampleVertex corner(float x, float y, float z, float u, float v) {
  constexpr float kHalf = MultisampleCanvas::kSide / 2;
  return {{x / kHalf - 1, 1 - y / kHalf, z}, {u, v}};
}

MultisampleCanvas::MultisampleCanvas(const Device& made, uint32_t sample_count, Format format,
                                     uint32_t elements)
    : device(made), samples(sample_count), format_(format), elements_(elements) {
  queue = device.CreateCommandQueue().value();
  root_signature_ = device
                        .CreateRootSignature(
                            "RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT), "
                            "RootConstants(num32BitConstants=4, b0), UAV(u0), "
                            "DescriptorTable(SRV(t0))")
                        .value();
  views_ =
      device
          .CreateDescriptorHeap({.NumDescriptors = 1, .Flags = DescriptorHeapFlags::kShaderVisible})
          .value();
  output_ = device
                .CreateBuffer({.SizeInBytes = kOutputBytes,
                               .Flags = ResourceFlags::kAllowUnorderedAccess,
                               .InitialState = ResourceStates::kUnorderedAccess,
                               .Name = "output"})
                .value();
  TextureDesc desc = {.Width = kSide,
                      .Height = kSide,
                      .DepthOrArraySize = static_cast<uint16_t>(elements),
                      .Format = format,
                      .SampleDesc = {samples, 0},
                      .Flags = ResourceFlags::kAllowRenderTarget,
                      .InitialState = ResourceStates::kRenderTarget,
                      .Name = "target"};
  target = device.CreateTexture(desc).value();
  desc.DepthOrArraySize = 1;
  desc.Format = Format::kR32Typeless;
  desc.Flags = ResourceFlags::kAllowDepthStencil;
  desc.InitialState = ResourceStates::kDepthWrite;
  desc.Name = "depth";
  depth_buffer = device.CreateTexture(desc).value();
  rtvs =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1}).value();
  dsvs =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kDsv, .NumDescriptors = 1}).value();
  RenderTargetViewDesc view;
  view.ViewDimension = RtvDimension::kTexture2DMSArray;
  view.Texture2DArray.FirstArraySlice = elements - 1;
  device.CreateRenderTargetView(target, view, rtvs.GetCPUDescriptorHandle(0)).value();
  device.CreateDepthStencilView(depth_buffer, dsvs.GetCPUDescriptorHandle(0)).value();
  device.CreateShaderResourceView(target, views_.GetCPUDescriptorHandle(0)).value();
}

GraphicsPipelineStateDesc MultisampleCanvas::desc(const std::string& vertex,
                                                  const std::string& pixel) const {
  GraphicsPipelineStateDesc desc;
  desc.pRootSignature = root_signature_;
  desc.VS = {library(), vertex};
  if (!pixel.empty()) desc.PS = {library(), pixel};
  desc.RasterizerState.CullMode = CullMode::kNone;
  desc.DepthStencilState.DepthEnable = false;
  if (vertex == "Corners") {
    desc.InputLayout = {{.SemanticName = "POSITION", .Format = Format::kR32G32B32Float},
                        {.SemanticName = "VALUE", .Format = Format::kR32G32Float}};
  }
  desc.RTVFormats = {format_};
  desc.DSVFormat = Format::kD32Float;
  desc.SampleDesc = {samples, 0};
  desc.Name = vertex + " and " + pixel;
  return desc;
}

PipelineState MultisampleCanvas::make(const GraphicsPipelineStateDesc& desc) const {
  return device.CreateGraphicsPipelineState(desc).value();
}

void MultisampleCanvas::use(CommandList& list, const PipelineState& pipeline,
                            std::array<float, 4> tint) const {
  list.SetPipelineState(pipeline);
  list.SetGraphicsRoot32BitConstants(0, tint);
}

void MultisampleCanvas::draw(CommandList& list, const std::vector<MultisampleVertex>& vertices) {
  const Buffer buffer = CreateUploadBuffer(device, vertices, "vertices").value();
  vertices_.push_back(buffer);
  list.IASetVertexBuffers(0, {buffer.GetGPUVirtualAddress(), static_cast<uint32_t>(buffer.size()),
                              sizeof(MultisampleVertex)});
  list.DrawInstanced(static_cast<uint32_t>(vertices.size()), 1, 0, 0);
}

void MultisampleCanvas::run(const Record& record) {
  const std::vector<uint32_t> zero = {0};
  const Buffer zeros = CreateUploadBuffer(device, zero, "zeros").value();
  CommandList list = device.CreateCommandList().value();
  list.ResourceBarrier(ResourceBarrier::Transition(output_, ResourceStates::kUnorderedAccess,
                                                   ResourceStates::kCopyDest));
  list.CopyBufferRegion(output_, 0, zeros, 0, 4);
  list.ResourceBarrier(ResourceBarrier::Transition(output_, ResourceStates::kCopyDest,
                                                   ResourceStates::kUnorderedAccess));
  const CpuDescriptorHandle rtv = rtvs.GetCPUDescriptorHandle(0);
  const CpuDescriptorHandle dsv = dsvs.GetCPUDescriptorHandle(0);
  const float black[4] = {0, 0, 0, 0};
  list.ClearRenderTargetView(rtv, black);
  list.ClearDepthStencilView(dsv, ClearFlags::kDepth, 1, 0);
  list.SetGraphicsRootSignature(root_signature_);
  list.SetGraphicsRootUnorderedAccessView(1, output_.GetGPUVirtualAddress());
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  list.RSSetViewports(Viewport{0, 0, kSide, kSide, 0, 1});
  list.RSSetScissorRects(Rect{0, 0, kSide, kSide});
  list.OMSetRenderTargets(1, &rtv, false, &dsv);
  record(list);
  list.Close().value();
  queue.ExecuteAndWait(list).value();
  vertices_.clear();
  const auto counted = ReadbackBuffer(device, queue, output_).value();
  std::memcpy(&invocations_, counted.data(), 4);
  texels_ = compute(elements_ == 1 ? "Read" : "ReadElement", kOutputBytes / 4);
}

std::vector<float> MultisampleCanvas::compute(const std::string& entry, uint32_t floats) {
  ComputePipelineStateDesc desc;
  desc.pRootSignature = root_signature_;
  desc.CS = library();
  desc.EntryPoint = entry;
  const PipelineState pipeline = device.CreateComputePipelineState(desc).value();
  CommandList list = device.CreateCommandList().value();
  constexpr ResourceStates kRead = ResourceStates::kNonPixelShaderResource;
  transition(list, target, ResourceStates::kRenderTarget, kRead);
  list.SetDescriptorHeaps({views_});
  list.SetComputeRootSignature(root_signature_);
  list.SetPipelineState(pipeline);
  list.SetComputeRootUnorderedAccessView(1, output_.GetGPUVirtualAddress());
  list.SetComputeRootDescriptorTable(2, views_.GetGPUDescriptorHandle(0));
  list.Dispatch(kSide / 8, kSide / 8, 1);
  transition(list, target, kRead, ResourceStates::kRenderTarget);
  list.Close().value();
  queue.ExecuteAndWait(list).value();
  const auto bytes = ReadbackBuffer(device, queue, output_).value();
  std::vector<float> out(floats);
  std::memcpy(out.data(), bytes.data(), floats * sizeof(float));
  return out;
}

std::vector<std::byte> MultisampleCanvas::resolved(Format format) {
  const Texture out = device
                          .CreateTexture({.Width = kSide,
                                          .Height = kSide,
                                          .Format = format_,
                                          .Flags = ResourceFlags::kAllowRenderTarget,
                                          .InitialState = ResourceStates::kResolveDest,
                                          .Name = "resolved"})
                          .value();
  CommandList list = device.CreateCommandList().value();
  transition(list, target, ResourceStates::kRenderTarget, ResourceStates::kResolveSource);
  list.ResolveSubresource(out, 0, target, elements_ - 1, format);
  transition(list, target, ResourceStates::kResolveSource, ResourceStates::kRenderTarget);
  list.Close().value();
  queue.ExecuteAndWait(list).value();
  return ReadbackTexture(device, queue, out, 0).value();
}

}  // namespace kaamos::draws
