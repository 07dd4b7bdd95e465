// SPDX-License-Identifier: MIT
#include "effects/engine/picture.h"

#include "effects/engine/texel.h"

namespace kaamos::effects {

rtapi::Result<rtapi::Texture> create_picture(const rtapi::Device& device, std::string name,
                                             rtapi::Format format, std::uint32_t width,
                                             std::uint32_t height) {
  rtapi::TextureDesc desc;
  desc.Width = width;
  desc.Height = height;
  desc.Format = format;
  desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = rtapi::ResourceStates::kUnorderedAccess;
  desc.Name = std::move(name);
  return device.CreateTexture(desc);
}

std::uint64_t picture_bytes(const rtapi::Texture& picture) {
  if (!picture) return 0;
  const rtapi::TextureDesc desc = picture.GetDesc();
  return std::uint64_t{desc.Width} * desc.Height * texel_bytes(desc.Format);
}

rtapi::Result<FloatImage> read_picture(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                       const rtapi::Texture& picture) {
  const auto bytes = rtapi::ReadbackTexture(device, queue, picture, 0);
  if (!bytes) return bytes.error();
  const rtapi::TextureDesc& desc = picture.GetDesc();
  return decode_texels(desc.Format, static_cast<std::uint32_t>(desc.Width), desc.Height, *bytes);
}

}  // namespace kaamos::effects
