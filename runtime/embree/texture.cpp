// SPDX-License-Identifier: MIT
#include "runtime/embree/texture.h"

#include <algorithm>

#include "runtime/embree/memory.h"

namespace kaamos::embree {

Texture::Texture(const rtapi::TextureDesc& desc)
    : desc_(desc), texel_bytes_(rtapi::GetFormatInfo(desc.Format).bytes) {
  const bool volume = desc.Dimension == rtapi::ResourceDimension::kTexture3D;
  array_size_ = volume ? 1 : desc.DepthOrArraySize;
  for (uint32_t mip = 0; mip < desc.MipLevels; ++mip) {
    mip_offsets_.push_back(element_bytes_);
    const uint64_t width = std::max(desc.Width >> mip, 1u);
    const uint64_t height = std::max(desc.Height >> mip, 1u);
    const uint64_t depth = volume ? std::max(desc.DepthOrArraySize >> mip, 1) : 1;
    element_bytes_ += (width * height * depth * texel_bytes_ + 15) / 16 * 16;
  }
}

std::shared_ptr<Texture> Texture::create(const rtapi::TextureDesc& desc) {
  std::shared_ptr<Texture> texture(new Texture(desc));
  texture->memory_ = Memory::allocate(texture->element_bytes_ * texture->array_size_);
  return texture->memory_ != nullptr ? texture : nullptr;
}

Texture::~Texture() {
  if (memory_ != nullptr) Memory::release(memory_, element_bytes_ * array_size_);
}

Texture::Subresource Texture::subresource(uint32_t mip, uint32_t array_element) const {
  Subresource result;
  result.texels = memory_ + array_element * element_bytes_ + mip_offsets_[mip];
  result.extent[0] = std::max(desc_.Width >> mip, 1u);
  result.extent[1] = std::max(desc_.Height >> mip, 1u);
  const bool volume = desc_.Dimension == rtapi::ResourceDimension::kTexture3D;
  result.extent[2] = volume ? std::max<uint32_t>(desc_.DepthOrArraySize >> mip, 1u) : 1;
  result.row_pitch = uint64_t{result.extent[0]} * texel_bytes_;
  result.slice_pitch = result.row_pitch * result.extent[1];
  return result;
}

}  // namespace kaamos::embree
