// SPDX-License-Identifier: MIT
#include "effects/assets/common/blue_noise.h"

#include "effects/assets/common/sampling.h"
#include "effects/assets/common/sobol.h"
#include "effects/assets/common/tables.h"

namespace kaamos::effects {

const std::vector<glm::vec2>& blue_noise_tile() {
  static const std::vector<glm::vec2> tile = [] {
    constexpr std::size_t kCells = std::size_t{kBlueNoiseSize} * kBlueNoiseSize;
    std::vector<glm::vec2> values(kCells);
    for (std::size_t i = 0; i < kCells; ++i)
      values[i] = (glm::vec2(kNoiseRanks[0][i], kNoiseRanks[1][i]) + 0.5f) / float{kCells};
    return values;
  }();
  return tile;
}

glm::vec2 pixel_sample(std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint32_t pair,
                       std::uint32_t seed) {
  const std::uint32_t h = hash_combine(seed, pair);
  const std::uint32_t mask = kBlueNoiseSize - 1;
  const std::uint32_t tx = (x + (h & mask)) & mask, ty = (y + ((h >> 16) & mask)) & mask;
  const glm::vec2 u = blue_noise_tile()[ty * kBlueNoiseSize + tx] + sobol_owen(index, pcg_hash(h));
  return u - glm::floor(u);
}

}  // namespace kaamos::effects
