// SPDX-License-Identifier: MIT
#include "effects/assets/image/image.h"

#include <cassert>
#include <cstddef>

namespace kaamos::effects {

FloatImage::FloatImage(std::uint32_t image_width, std::uint32_t image_height,
                       std::uint32_t image_channels, float value)
    : width(image_width),
      height(image_height),
      channels(image_channels),
      values(std::size_t{image_width} * image_height * image_channels, value) {}

float& FloatImage::at(std::uint32_t x, std::uint32_t y, std::uint32_t c) {
  assert(x < width && y < height && c < channels);
  return values[(std::size_t{y} * width + x) * channels + c];
}

float FloatImage::at(std::uint32_t x, std::uint32_t y, std::uint32_t c) const {
  assert(x < width && y < height && c < channels);
  return values[(std::size_t{y} * width + x) * channels + c];
}

}  // namespace kaamos::effects
