// SPDX-License-Identifier: MIT
#include "d3d12/objects/format_support.h"

namespace kaamos::d3d12 {

namespace {

// Tries textures of 4 x 4 texels and views of them. Nothing is reported: a refusal is an answer.
class Probe {
 public:
  Probe(const rtapi::Device& device, rtapi::Format format) : device_(device), format_(format) {}

  bool texture(rtapi::ResourceDimension dimension) const {
    rtapi::TextureDesc desc = {.Dimension = dimension, .Width = 4, .Format = format_};
    if (dimension != rtapi::ResourceDimension::kTexture1D) desc.Height = 4;
    return device_.CreateTexture(desc).ok();
  }

  bool render_target() const {
    const auto made = target(rtapi::ResourceFlags::kAllowRenderTarget);
    const auto heap = one_slot(rtapi::DescriptorHeapType::kRtv);
    return made.ok() && heap.ok() &&
           device_.CreateRenderTargetView(*made, heap->GetCPUDescriptorHandle(0)).ok();
  }

  bool depth_stencil() const {
    if (!rtapi::IsDepthFormat(format_)) return false;
    const auto made = target(rtapi::ResourceFlags::kAllowDepthStencil);
    const auto heap = one_slot(rtapi::DescriptorHeapType::kDsv);
    return made.ok() && heap.ok() &&
           device_.CreateDepthStencilView(*made, heap->GetCPUDescriptorHandle(0)).ok();
  }

  bool shader_resource() const {
    const auto made = target(rtapi::ResourceFlags::kNone);
    const auto heap = one_slot(rtapi::DescriptorHeapType::kCbvSrvUav);
    return made.ok() && heap.ok() &&
           device_.CreateShaderResourceView(*made, heap->GetCPUDescriptorHandle(0)).ok();
  }

  bool unordered_access() const {
    const auto made = target(rtapi::ResourceFlags::kAllowUnorderedAccess);
    const auto heap = one_slot(rtapi::DescriptorHeapType::kCbvSrvUav);
    return made.ok() && heap.ok() &&
           device_.CreateUnorderedAccessView(*made, heap->GetCPUDescriptorHandle(0)).ok();
  }

  bool typed_buffer() const {
    const auto buffer = device_.CreateBuffer({.SizeInBytes = 256});
    const auto heap = one_slot(rtapi::DescriptorHeapType::kCbvSrvUav);
    rtapi::ShaderResourceViewDesc view;
    view.Format = format_;
    view.ViewDimension = rtapi::SrvDimension::kBuffer;
    view.Buffer.NumElements = 1;
    return buffer.ok() && heap.ok() &&
           device_.CreateShaderResourceView(*buffer, view, heap->GetCPUDescriptorHandle(0)).ok();
  }

 private:
  rtapi::Result<rtapi::Texture> target(rtapi::ResourceFlags flags) const {
    return device_.CreateTexture({.Width = 4, .Height = 4, .Format = format_, .Flags = flags});
  }
  rtapi::Result<rtapi::DescriptorHeap> one_slot(rtapi::DescriptorHeapType type) const {
    return device_.CreateDescriptorHeap({.Type = type, .NumDescriptors = 1});
  }

  const rtapi::Device& device_;
  rtapi::Format format_;
};

}  // namespace

D3D12_FEATURE_DATA_FORMAT_SUPPORT format_support(const rtapi::Device& device, DXGI_FORMAT format) {
  const auto rtapi_format = static_cast<rtapi::Format>(format);
  const rtapi::FormatInfo info = rtapi::GetFormatInfo(rtapi_format);
  UINT one = 0, two = 0;
  if (format == DXGI_FORMAT_UNKNOWN) one = D3D12_FORMAT_SUPPORT1_BUFFER;
  if (info.bytes != 0) {
    const Probe probe(device, rtapi_format);
    const bool whole =
        info.type == rtapi::FormatClass::kUint || info.type == rtapi::FormatClass::kSint;
    if (probe.texture(rtapi::ResourceDimension::kTexture1D)) {
      one |= D3D12_FORMAT_SUPPORT1_TEXTURE1D;
    }
    if (probe.texture(rtapi::ResourceDimension::kTexture2D)) {
      one |= D3D12_FORMAT_SUPPORT1_TEXTURE2D | D3D12_FORMAT_SUPPORT1_TEXTURECUBE |
             D3D12_FORMAT_SUPPORT1_MIP | D3D12_FORMAT_SUPPORT1_CAST_WITHIN_BIT_LAYOUT;
    }
    if (probe.texture(rtapi::ResourceDimension::kTexture3D)) {
      one |= D3D12_FORMAT_SUPPORT1_TEXTURE3D;
    }
    if (probe.shader_resource()) {
      one |= D3D12_FORMAT_SUPPORT1_SHADER_LOAD | D3D12_FORMAT_SUPPORT1_SHADER_GATHER;
      if (!whole) one |= D3D12_FORMAT_SUPPORT1_SHADER_SAMPLE;
      if (rtapi_format == rtapi::Format::kR32Float || rtapi_format == rtapi::Format::kR16Unorm ||
          rtapi_format == rtapi::Format::kR24UnormX8Typeless) {
        one |= D3D12_FORMAT_SUPPORT1_SHADER_SAMPLE_COMPARISON |
               D3D12_FORMAT_SUPPORT1_SHADER_GATHER_COMPARISON;
      }
    }
    if (probe.typed_buffer()) {
      one |= D3D12_FORMAT_SUPPORT1_BUFFER | D3D12_FORMAT_SUPPORT1_IA_VERTEX_BUFFER;
    }
    if (rtapi_format == rtapi::Format::kR16Uint || rtapi_format == rtapi::Format::kR32Uint) {
      one |= D3D12_FORMAT_SUPPORT1_IA_INDEX_BUFFER;
    }
    if (probe.render_target()) {
      one |= D3D12_FORMAT_SUPPORT1_RENDER_TARGET;
      if (!whole) one |= D3D12_FORMAT_SUPPORT1_BLENDABLE;
      if (rtapi::GetFormatInfo(rtapi_format).type == rtapi::FormatClass::kUint) {
        two |= D3D12_FORMAT_SUPPORT2_OUTPUT_MERGER_LOGIC_OP;
      }
    }
    if (probe.depth_stencil()) one |= D3D12_FORMAT_SUPPORT1_DEPTH_STENCIL;
    if (probe.unordered_access()) {
      one |= D3D12_FORMAT_SUPPORT1_TYPED_UNORDERED_ACCESS_VIEW;
      two |= D3D12_FORMAT_SUPPORT2_UAV_TYPED_LOAD | D3D12_FORMAT_SUPPORT2_UAV_TYPED_STORE;
      if (rtapi_format == rtapi::Format::kR32Uint || rtapi_format == rtapi::Format::kR32Sint) {
        two |= D3D12_FORMAT_SUPPORT2_UAV_ATOMIC_ADD | D3D12_FORMAT_SUPPORT2_UAV_ATOMIC_BITWISE_OPS |
               D3D12_FORMAT_SUPPORT2_UAV_ATOMIC_COMPARE_STORE_OR_COMPARE_EXCHANGE |
               D3D12_FORMAT_SUPPORT2_UAV_ATOMIC_EXCHANGE |
               (rtapi_format == rtapi::Format::kR32Sint
                    ? D3D12_FORMAT_SUPPORT2_UAV_ATOMIC_SIGNED_MIN_OR_MAX
                    : D3D12_FORMAT_SUPPORT2_UAV_ATOMIC_UNSIGNED_MIN_OR_MAX);
      }
    }
  }
  return {format, static_cast<D3D12_FORMAT_SUPPORT1>(one), static_cast<D3D12_FORMAT_SUPPORT2>(two)};
}

}  // namespace kaamos::d3d12
