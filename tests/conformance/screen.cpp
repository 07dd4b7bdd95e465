// SPDX-License-Identifier: MIT
#include "tests/conformance/screen.h"

#include <rtapi/upload.h>
#include <shaders/ras.h>

namespace kaamos::conformance {

using namespace rtapi;

InputElementDesc element(const std::string& semantic, Format format, uint32_t slot,
                         uint32_t index) {
  InputElementDesc out;
  out.SemanticName = semantic;
  out.SemanticIndex = index;
  out.Format = format;
  out.InputSlot = slot;
  return out;
}

InputElementDesc instance_element(const std::string& semantic, Format format, uint32_t slot,
                                  uint32_t step_rate, uint32_t index) {
  InputElementDesc out = element(semantic, format, slot, index);
  out.InputSlotClass = InputClassification::kPerInstanceData;
  out.InstanceDataStepRate = step_rate;
  return out;
}

Format typeless_of_depth(Format depth) {
  switch (depth) {
    case Format::kD16Unorm:
      return Format::kR16Typeless;
    case Format::kD24UnormS8Uint:
      return Format::kR24G8Typeless;
    case Format::kD32FloatS8X24Uint:
      return Format::kR32G8X24Typeless;
    default:
      return Format::kR32Typeless;
  }
}

Screen::Screen(Context& t, std::vector<Format> color_formats, Format depth, uint32_t size,
               uint16_t slices)
    : context_(&t),
      formats_(std::move(color_formats)),
      depth_format_(depth),
      size_(size),
      slices_(slices) {
  const Device& device = t.device();
  root_signature = device.CreateRootSignature(kDrawSignature).value();
  words = t.zeros(4096);
  views =
      device
          .CreateDescriptorHeap({.NumDescriptors = 4, .Flags = DescriptorHeapFlags::kShaderVisible})
          .value();
  DescriptorHeapDesc heap = {.Type = DescriptorHeapType::kRtv,
                             .NumDescriptors = static_cast<uint32_t>(formats_.size()) + 1};
  rtvs_ = device.CreateDescriptorHeap(heap).value();
  heap.Type = DescriptorHeapType::kDsv;
  dsvs_ = device.CreateDescriptorHeap(heap).value();
  TextureDesc desc = {.Width = size, .Height = size, .DepthOrArraySize = slices};
  for (uint32_t i = 0; i < formats_.size(); ++i) {
    colors.emplace_back();
    if (formats_[i] == Format::kUnknown) {
      const RenderTargetViewDesc null_view = {.Format = Format::kR8G8B8A8Unorm,
                                              .ViewDimension = RtvDimension::kTexture2D};
      device.CreateRenderTargetView(Texture(), null_view, rtv(i)).value();
      continue;
    }
    desc.Format = formats_[i];
    desc.Flags = ResourceFlags::kAllowRenderTarget;
    desc.InitialState = ResourceStates::kRenderTarget;
    desc.Name = "target " + std::to_string(i);
    colors.back() = device.CreateTexture(desc).value();
    const bool typeless = GetFormatInfo(formats_[i]).type == FormatClass::kTypeless;
    if (!typeless) device.CreateRenderTargetView(colors[i], rtv(i)).value();
  }
  if (depth == Format::kUnknown) return;
  desc.Format = typeless_of_depth(depth);
  desc.Flags = ResourceFlags::kAllowDepthStencil;
  desc.InitialState = ResourceStates::kDepthWrite;
  desc.Name = "depth";
  depth_texture = device.CreateTexture(desc).value();
  DepthStencilViewDesc view;
  view.Format = depth;
  view.ViewDimension = DsvDimension::kTexture2DArray;
  device.CreateDepthStencilView(depth_texture, view, dsv()).value();
}

GraphicsShader Screen::shader(const std::string& name) const {
  if (library != nullptr) {
    const ShaderLibrary own = LoadShaderLibrary(library).value();
    if (own.FindExport(name) != nullptr) return {own, name};
  }
  return {LoadShaderLibrary(kaamos_shaders_ras()).value(), name};
}

GraphicsPipelineStateDesc Screen::desc(const std::string& vertex, const std::string& pixel) const {
  GraphicsPipelineStateDesc out;
  out.pRootSignature = root_signature;
  out.VS = shader(vertex);
  if (!pixel.empty()) out.PS = shader(pixel);
  out.RasterizerState.CullMode = CullMode::kNone;
  out.DepthStencilState.DepthEnable = depth_format_ != Format::kUnknown;
  out.RTVFormats = formats_;
  out.DSVFormat = depth_format_;
  out.Name = vertex + " and " + (pixel.empty() ? "none" : pixel);
  if (vertex == "Pass") {
    out.InputLayout = {element("POSITION", Format::kR32G32B32A32Float),
                       element("VALUE", Format::kR32G32B32A32Float)};
  }
  return out;
}

Corner Screen::at(float x, float y, float z, float w, std::array<float, 4> value) const {
  const float half = static_cast<float>(size_) / 2;
  return {{(x / half - 1) * w, (1 - y / half) * w, z * w, w}, value};
}

std::vector<Corner> Screen::rectangle(float left, float top, float right, float bottom, float z,
                                      std::array<float, 4> value) const {
  const Corner corners[] = {at(left, top, z, 1, value), at(right, top, z, 1, value),
                            at(left, bottom, z, 1, value), at(right, bottom, z, 1, value)};
  return {corners[0], corners[1], corners[2], corners[2], corners[1], corners[3]};
}

void Screen::begin(CommandList& list) const {
  list.SetDescriptorHeaps({views});
  list.SetGraphicsRootSignature(root_signature);
  list.SetGraphicsRootUnorderedAccessView(kOut, words.GetGPUVirtualAddress());
  list.SetGraphicsRootDescriptorTable(kTable, views.GetGPUDescriptorHandle(0));
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  const auto side = static_cast<float>(size_);
  const auto end = static_cast<int32_t>(size_);
  list.RSSetViewports(Viewport{0, 0, side, side, 0, 1});
  list.RSSetScissorRects(Rect{0, 0, end, end});
  std::vector<CpuDescriptorHandle> handles;
  for (uint32_t i = 0; i < colors.size(); ++i) handles.push_back(rtv(i));
  const CpuDescriptorHandle depth_handle = dsv();
  list.OMSetRenderTargets(static_cast<uint32_t>(handles.size()), handles.data(), false,
                          depth_texture ? &depth_handle : nullptr);
}

void Screen::run(const std::function<void(CommandList&)>& record) {
  CommandList list = context_->device().CreateCommandList().value();
  if (clears) {
    for (uint32_t i = 0; i < colors.size(); ++i) {
      if (colors[i]) list.ClearRenderTargetView(rtv(i), clear_color.data());
    }
    if (depth_texture) list.ClearDepthStencilView(dsv(), ClearFlags::kDepth, clear_depth, 0);
  }
  begin(list);
  record(list);
  list.Close().value();
  context_->queue().ExecuteAndWait(list).value();
  read();
}

void Screen::read() {
  texels_.clear();
  for (const Texture& color : colors) {
    for (uint16_t slice = 0; slice < slices_; ++slice) {
      texels_.emplace_back();
      if (!color) continue;
      texels_.back() = ReadbackTexture(context_->device(), context_->queue(), color, slice).value();
    }
  }
  if (depth_format_ == Format::kD32Float || depth_format_ == Format::kD16Unorm) {
    depth_texels_ =
        ReadbackTexture(context_->device(), context_->queue(), depth_texture, 0).value();
  }
}

void Screen::use(CommandList& list, const PipelineState& pipeline, const DrawConstants& constants) {
  list.SetPipelineState(pipeline);
  list.SetGraphicsRoot32BitConstants(kConstants, constants);
}

void Screen::vertices(CommandList& list, const std::vector<Corner>& corners) {
  list.IASetVertexBuffers(0, view(corners));
}

void Screen::draw(CommandList& list, const PipelineState& pipeline,
                  const std::vector<Corner>& corners, const DrawConstants& constants) {
  use(list, pipeline, constants);
  vertices(list, corners);
  list.DrawInstanced(static_cast<uint32_t>(corners.size()), 1, 0, 0);
}

void Screen::draw(const PipelineState& pipeline, const std::vector<Corner>& corners,
                  const DrawConstants& constants) {
  run([&](CommandList& list) { draw(list, pipeline, corners, constants); });
}

void Screen::cover(CommandList& list, const PipelineState& pipeline,
                   const DrawConstants& constants) {
  use(list, pipeline, constants);
  list.DrawInstanced(3, 1, 0, 0);
}

Fact Screen::fact(uint32_t x, uint32_t y) const {
  const auto flags = texel<uint32_t>(x, y, 2);
  return {texel<uint32_t>(x, y, 0), texel<uint32_t>(x, y, 1), flags & 0xFFFFu,
          (flags & 0x10000u) != 0,  texel<uint32_t>(x, y, 3), (flags & 0x20000u) != 0};
}

uint32_t Screen::depth_bits(uint32_t x, uint32_t y) const {
  uint32_t out = 0;
  const size_t bytes = depth_format_ == Format::kD16Unorm ? 2 : 4;
  std::memcpy(&out, depth_texels_.data() + (size_t{y} * size_ + x) * bytes, bytes);
  return out;
}

float Screen::depth(uint32_t x, uint32_t y) const {
  const uint32_t bits = depth_bits(x, y);
  if (depth_format_ == Format::kD16Unorm) return static_cast<float>(bits) / 65535;
  float out;
  std::memcpy(&out, &bits, sizeof out);
  return out;
}

uint32_t Screen::count(const std::function<bool(uint32_t, uint32_t)>& condition) const {
  uint32_t out = 0;
  for (uint32_t y = 0; y < size_; ++y) {
    for (uint32_t x = 0; x < size_; ++x) out += condition(x, y) ? 1 : 0;
  }
  return out;
}

uint32_t Screen::covered(size_t target, uint32_t slice) const {
  return count([&](uint32_t x, uint32_t y) { return texel<float>(x, y, 0, target, slice) != 0; });
}

}  // namespace kaamos::conformance
