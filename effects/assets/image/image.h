// SPDX-License-Identifier: MIT
/// @file
/// Pictures on the host: floats as the effects compute them, bytes as files show them.
#pragma once

#include <cstdint>
#include <vector>

namespace kaamos::effects {

/// `channels` floats per pixel, row 0 on top, no padding.
struct FloatImage {
  std::uint32_t width = 0;     ///< pixels
  std::uint32_t height = 0;    ///< pixels
  std::uint32_t channels = 0;  ///< floats per pixel
  std::vector<float> values;   ///< width * height * channels, channels of a pixel side by side

  /// An empty picture.
  FloatImage() = default;
  /// A picture filled with `value`.
  FloatImage(std::uint32_t image_width, std::uint32_t image_height, std::uint32_t image_channels,
             float value = 0.0f);
  /// Value of a channel; x < width, y < height, c < channels.
  ///@{
  float& at(std::uint32_t x, std::uint32_t y, std::uint32_t c = 0);
  float at(std::uint32_t x, std::uint32_t y, std::uint32_t c = 0) const;
  ///@}
};

/// 8 bits per channel: 1 (grey), 3 (RGB) or 4 (RGBA) channels, row 0 on top, no padding.
struct ByteImage {
  std::uint32_t width = 0;     ///< pixels
  std::uint32_t height = 0;    ///< pixels
  std::uint32_t channels = 0;  ///< bytes per pixel: 1, 3 or 4
  std::vector<std::uint8_t>
      values;  ///< width * height * channels, channels of a pixel side by side
};

}  // namespace kaamos::effects
