// SPDX-License-Identifier: MIT
// A texture for tests of levels of detail: alternating black and white texels, whose mean is grey.
#pragma once

#include "effects/assets/scene/texture_image.h"

namespace kaamos::effects {

inline TextureImage make_checkers() {
  TextureImage image;
  image.name = "checkers";
  image.width = image.height = 64;
  std::vector<std::uint8_t> texels;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const std::uint8_t value = (x + y) % 2 == 0 ? 255 : 0;
      texels.insert(texels.end(), {value, value, value, 255});
    }
  }
  image.mips.push_back(std::move(texels));
  generate_mips(image);
  return image;
}

}  // namespace kaamos::effects
