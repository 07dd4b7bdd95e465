// SPDX-License-Identifier: MIT
// WebP pictures, where the build has libwebp; only gltf_*.cpp include it. [EXT_texture_webp]
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "effects/assets/scene/texture_image.h"

namespace kaamos::effects {

/// False: the build has no libwebp, and read_webp_header and decode_webp read nothing.
bool can_read_webp();

/// True for the first bytes of a WebP file.
bool is_webp(std::span<const std::uint8_t> bytes);

/// What the first bytes of a WebP file say of the picture.
struct WebpHeader {
  int width;  // texels; at most 16,383, as the height
  int height;
  bool is_animated;
};
/// Nothing where the bytes are damaged.
std::optional<WebpHeader> read_webp_header(std::span<const std::uint8_t> bytes);

/// Decodes to RGBA: sets size and level 0 of `to`. False where the bytes are damaged.
bool decode_webp(std::span<const std::uint8_t> bytes, TextureImage& to);

}  // namespace kaamos::effects
