// SPDX-License-Identifier: MIT
#include "effects/shadows/shadow_map/disk_points.h"

#include <algorithm>
#include <cmath>

#include "effects/assets/common/sampling.h"

namespace kaamos::effects {

std::vector<glm::vec2> disk_points(std::uint32_t count) {
  constexpr std::uint32_t kCandidates = 32;  // for each point that there is
  std::vector<glm::vec2> points;
  std::uint32_t key = 0;
  while (points.size() < count) {
    glm::vec2 best(0.0f);
    float best_distance = -1;
    for (std::uint32_t i = 0; i < kCandidates * (points.size() + 1); ++i) {
      const float u = unit_float(pcg_hash(key++)), v = unit_float(pcg_hash(key++));
      const glm::vec2 candidate =
          std::sqrt(u) * glm::vec2(std::cos(6.2831853f * v), std::sin(6.2831853f * v));
      float distance = 8;
      for (const glm::vec2& p : points) {
        distance = std::min(distance, glm::dot(p - candidate, p - candidate));
      }
      if (distance <= best_distance) continue;
      best_distance = distance;
      best = candidate;
    }
    points.push_back(best);
  }
  return points;
}

}  // namespace kaamos::effects
