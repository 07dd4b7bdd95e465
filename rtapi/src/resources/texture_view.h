// SPDX-License-Identifier: MIT
//
// Descriptors of texture views: which part of a texture they look at, and in what format.
#pragma once

#include "rtapi/src/device/device_impl.h"

namespace rtapi::detail {

// The part of a texture that a view asks for, before "all the rest" is resolved.
struct TextureView {
  Format format;
  SrvDimension dimension;
  bool uav = false;
  uint32_t first_mip = 0;
  uint32_t mips = 1;
  uint32_t first_slice = 0;
  uint32_t slices = 1;
  float min_lod = 0;
};

TextureView from_srv(const ShaderResourceViewDesc& desc);
TextureView from_uav(const UnorderedAccessViewDesc& desc);
// The dimension of a view of the whole texture. As in D3D12, 2-D textures with several elements get
// an array view.
SrvDimension whole_dimension(const TextureDesc& desc);

// Checks the view and lets the backend make it. `mapping` is a Shader4ComponentMapping.
Result<shader::Descriptor> make_texture_descriptor(const std::shared_ptr<DeviceImpl>& device,
                                                   const Texture& texture, TextureView view,
                                                   uint32_t mapping);

}  // namespace rtapi::detail
