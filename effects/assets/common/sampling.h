// SPDX-License-Identifier: MIT
/// @file
/// The random numbers and sampling routines of effects/shaders/sampling.hlsli for the host, so that
/// tests can compare a shader with them. The values are equal except for sine and cosine, which
/// differ between backends.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace kaamos::effects {

/// One step of a permuted congruential generator as a hash. [O'Neill 2014; Jarzynski & Olano 2020]
inline std::uint32_t pcg_hash(std::uint32_t v) {
  const std::uint32_t state = v * 747796405u + 2891336453u;
  const std::uint32_t word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

/// A hash of two numbers, in this order.
inline std::uint32_t hash_combine(std::uint32_t seed, std::uint32_t v) {
  return pcg_hash(seed ^ pcg_hash(v));
}

/// The upper 24 bits as a float in [0, 1): every value is exact, 1 is never reached.
inline float unit_float(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * (1.0f / 16777216.0f);
}

/// Unit disk, area preserving.
inline glm::vec2 sample_disk(const glm::vec2& u) {
  const float r = std::sqrt(u.x), phi = 6.2831853f * u.y;
  return {r * std::cos(phi), r * std::sin(phi)};
}

/// Direction about +Z with density cos(theta) / pi.
inline glm::vec3 sample_cosine_hemisphere(const glm::vec2& u) {
  const glm::vec2 d = sample_disk(u);
  return {d.x, d.y, std::sqrt(std::fmax(0.0f, 1.0f - u.x))};
}

/// The direction `local` about +Z turned to lie about the unit vector `n`. [Duff et al. 2017]
inline glm::vec3 to_world(const glm::vec3& local, const glm::vec3& n) {
  const float sign = n.z >= 0.0f ? 1.0f : -1.0f;
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  const glm::vec3 t(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
  const glm::vec3 s(b, sign + n.y * n.y * a, -n.y);
  return t * local.x + s * local.y + n * local.z;
}

/// Direction to a point of the sun's disk, uniform over the disk.
inline glm::vec3 sample_sun(const glm::vec2& u, const glm::vec3& direction_to_sun,
                            float tan_angular_radius) {
  const glm::vec2 d = sample_disk(u) * tan_angular_radius;
  return glm::normalize(to_world(glm::vec3(d, 1.0f), direction_to_sun));
}

}  // namespace kaamos::effects
