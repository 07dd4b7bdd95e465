// SPDX-License-Identifier: MIT
#include "d3d12/objects/resource.h"

namespace kaamos::d3d12 {

Resource::Resource(ID3D12Device* device, rtapi::Resource resource, const D3D12_RESOURCE_DESC1& desc,
                   const D3D12_HEAP_PROPERTIES& heap, D3D12_HEAP_FLAGS heap_flags,
                   Microsoft::WRL::ComPtr<ID3D12Heap> placed_in)
    : DeviceChild(device),
      resource_(std::move(resource)),
      desc_(desc),
      heap_(heap),
      heap_flags_(heap_flags),
      placed_in_(std::move(placed_in)) {
  if (const rtapi::Texture texture = this->texture()) {
    desc_.MipLevels = texture.GetDesc().MipLevels;  // 0 asked for the full chain
  }
}

rtapi::Buffer Resource::buffer() const {
  const auto* buffer = std::get_if<rtapi::Buffer>(&resource_);
  return buffer != nullptr ? *buffer : rtapi::Buffer{};
}

rtapi::Texture Resource::texture() const {
  const auto* texture = std::get_if<rtapi::Texture>(&resource_);
  return texture != nullptr ? *texture : rtapi::Texture{};
}

// Mapped memory stays mapped, so that ranges and the count of Unmap do not matter.
HRESULT Resource::Map(UINT subresource, const D3D12_RANGE* read_range, void** data) {
  if (data != nullptr) *data = nullptr;
  const rtapi::Buffer buffer = this->buffer();
  if (!buffer) {
    return fail(ErrorId::kMap,
                "texture \"" + texture().name() + "\": textures are not mapped here.");
  }
  if (subresource != 0) {
    return fail(ErrorId::kMap, "buffer \"" + buffer.name() + "\": subresource " +
                                   std::to_string(subresource) + "; a buffer has only 0.");
  }
  if (read_range != nullptr && read_range->End > buffer.size()) {
    return fail(ErrorId::kMap, "buffer \"" + buffer.name() + "\": pReadRange ends at byte " +
                                   std::to_string(read_range->End) + " of " +
                                   std::to_string(buffer.size()) + ".");
  }
  const auto mapped = buffer.Map();
  if (!mapped) return fail(mapped.error());
  if (data != nullptr) *data = mapped->data();
  return S_OK;
}

D3D12_RESOURCE_DESC Resource::GetDesc() {
  return {desc_.Dimension, desc_.Alignment, desc_.Width,      desc_.Height, desc_.DepthOrArraySize,
          desc_.MipLevels, desc_.Format,    desc_.SampleDesc, desc_.Layout, desc_.Flags};
}

D3D12_GPU_VIRTUAL_ADDRESS Resource::GetGPUVirtualAddress() {
  return buffer().GetGPUVirtualAddress();
}

HRESULT Resource::GetHeapProperties(D3D12_HEAP_PROPERTIES* properties, D3D12_HEAP_FLAGS* flags) {
  if (properties != nullptr) *properties = heap_;
  if (flags != nullptr) *flags = heap_flags_;
  return S_OK;
}

void Resource::rename(const std::string& name) {
  if (auto* buffer = std::get_if<rtapi::Buffer>(&resource_)) buffer->SetName(name);
  if (auto* texture = std::get_if<rtapi::Texture>(&resource_)) texture->SetName(name);
}

D3D12_RESOURCE_DESC1 with_sampler_feedback(const D3D12_RESOURCE_DESC& desc) {
  return {desc.Dimension,        desc.Alignment, desc.Width,  desc.Height,
          desc.DepthOrArraySize, desc.MipLevels, desc.Format, desc.SampleDesc,
          desc.Layout,           desc.Flags,     {}};
}

rtapi::Result<rtapi::TextureDesc> texture_desc(const D3D12_RESOURCE_DESC1& desc) {
  if (desc.SampleDesc.Count > 1) {
    return make_error(ErrorId::kResource, "SampleDesc.Count is " +
                                              std::to_string(desc.SampleDesc.Count) +
                                              "; textures have one sample here.");
  }
  if (desc.Width > UINT32_MAX) {
    return make_error(ErrorId::kResource,
                      "Width is " + std::to_string(desc.Width) + "; textures have up to 16384.");
  }
  if (desc.Layout != D3D12_TEXTURE_LAYOUT_UNKNOWN &&
      desc.Layout != D3D12_TEXTURE_LAYOUT_64KB_UNDEFINED_SWIZZLE) {
    return make_error(ErrorId::kResource,
                      "Layout is " + std::to_string(desc.Layout) +
                          "; textures are of D3D12_TEXTURE_LAYOUT_UNKNOWN here. Copy rows through "
                          "an upload or readback buffer.");
  }
  rtapi::TextureDesc out;
  out.Dimension = static_cast<rtapi::ResourceDimension>(desc.Dimension);
  out.Width = static_cast<uint32_t>(desc.Width);
  out.Height = desc.Height;
  out.DepthOrArraySize = desc.DepthOrArraySize;
  out.MipLevels = desc.MipLevels;
  out.Format = static_cast<rtapi::Format>(desc.Format);
  // Flags about sharing and simultaneous access change nothing where one queue executes at a time.
  out.Flags = static_cast<rtapi::ResourceFlags>(desc.Flags & 0xF);
  return out;
}

}  // namespace kaamos::d3d12
