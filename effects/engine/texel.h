// SPDX-License-Identifier: MIT
/// @file
/// Reads texels of the frame's pictures as floats.
#pragma once

#include <rtapi/format.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "effects/assets/image/image.h"

namespace kaamos::effects {

/// Turns rows without padding into floats. The formats are those that frames have: R32_FLOAT,
/// R32G32B32A32_FLOAT, R16G16B16A16_FLOAT, R16G16_SNORM, R8G8B8A8_UNORM, R32G32_UINT. An empty
/// image for any other.
FloatImage decode_texels(rtapi::Format format, std::uint32_t width, std::uint32_t height,
                         std::span<const std::byte> texels);

/// Bytes of one texel of these formats; 0 for any other.
std::uint32_t texel_bytes(rtapi::Format format);

}  // namespace kaamos::effects
