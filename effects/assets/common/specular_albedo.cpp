// SPDX-License-Identifier: MIT
#include "effects/assets/common/specular_albedo.h"

#include <algorithm>
#include <cmath>

#include "effects/assets/common/tables.h"

namespace kaamos::effects {

const std::vector<glm::vec2>& split_albedo_table() {
  static const std::vector<glm::vec2> table = [] {
    std::vector<glm::vec2> out;
    for (const auto& [scale, offset] : kAlbedoSplits) out.emplace_back(scale, offset);
    return out;
  }();
  return table;
}

glm::vec3 specular_albedo(const glm::vec3& f0, float roughness, float cosine) {
  const std::vector<glm::vec2>& table = split_albedo_table();
  const float x = std::sqrt(std::clamp(cosine, 0.0f, 1.0f)) * (kSpecularAlbedoCosines - 1);
  const float y = std::clamp(roughness, 0.0f, 1.0f) * (kSpecularAlbedoRoughnesses - 1);
  const auto left = std::min(static_cast<std::uint32_t>(x), kSpecularAlbedoCosines - 2);
  const auto low = std::min(static_cast<std::uint32_t>(y), kSpecularAlbedoRoughnesses - 2);
  const float part = x - static_cast<float>(left);
  const glm::vec2* row = &table[low * kSpecularAlbedoCosines + left];
  const glm::vec2 split =
      glm::mix(glm::mix(row[0], row[1], part),
               glm::mix(row[kSpecularAlbedoCosines], row[kSpecularAlbedoCosines + 1], part),
               y - static_cast<float>(low));
  return f0 * split.x + split.y;
}

}  // namespace kaamos::effects
