// SPDX-License-Identifier: MIT
/// @file
/// A picture that passes write and read. The texture stays in unordered-access state, so no pass
/// needs a transition, only a UAV barrier after the pass that wrote it.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <string>

#include "effects/assets/image/image.h"

namespace kaamos::effects {

/// A picture of zeros. `format` is one that decode_texels knows.
/// @errors those of rtapi::Device::CreateTexture.
rtapi::Result<rtapi::Texture> create_picture(const rtapi::Device& device, std::string name,
                                             rtapi::Format format, std::uint32_t width,
                                             std::uint32_t height);

/// Bytes that its texels take; 0 for an empty texture.
std::uint64_t picture_bytes(const rtapi::Texture& picture);

/// A picture as floats: 1, 2 or 4 channels as its format has; integers are exact up to 2^24.
/// @errors those of rtapi::ReadbackTexture.
rtapi::Result<FloatImage> read_picture(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                       const rtapi::Texture& picture);

}  // namespace kaamos::effects
