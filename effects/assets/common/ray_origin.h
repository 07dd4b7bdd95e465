// SPDX-License-Identifier: MIT
/// @file
/// Computes where a ray that leaves a triangle must start, so that it neither hits that triangle
/// again nor misses what is close by. Instead of a fixed epsilon it uses a bound of the point's own
/// rounding error. The same as effects/shaders/geometry.hlsli, value for value. [error bound of
/// Waechter, van Antwerpen and Klehm 2023]
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace kaamos::effects {

/// A point of a triangle in world space and how far it may be off.
struct SpawnPoint {
  glm::vec3 position{0.0f};  ///< world space, metres
  glm::vec3 normal{0.0f};    ///< unit, of the triangle; zero where the triangle has no area
  float offset = 0.0f;       ///< along the normal, metres
};

namespace detail {

inline glm::vec3 rows_times_point(const glm::mat3x4& rows, const glm::vec3& p) {
  glm::vec3 out;
  for (int r = 0; r < 3; ++r)
    out[r] = rows[r].w + (rows[r].x * p.x + (rows[r].y * p.y + rows[r].z * p.z));
  return out;
}

}  // namespace detail

/// `barycentrics` as DXR gives them: weights of v1 and v2. The matrices hold the three rows of
/// ObjectToWorld3x4() and WorldToObject3x4(), as transform_3x4 makes them.
inline SpawnPoint make_spawn_point(const glm::vec3& v0, const glm::vec3& v1, const glm::vec3& v2,
                                   const glm::vec2& barycentrics,
                                   const glm::mat3x4& object_to_world,
                                   const glm::mat3x4& world_to_object) {
  constexpr float kC0 = 5.9604644775390625e-8f;   // 2^-24
  constexpr float kC1 = 1.78813934326171875e-7f;  // 3 * 2^-24
  constexpr float kC2 = 1.1920928955078125e-7f;   // 2^-23
  const glm::vec3 e1 = v1 - v0, e2 = v2 - v0;
  const glm::vec3 p = v0 + (e1 * barycentrics.x + e2 * barycentrics.y);

  const glm::vec3 a1 = glm::abs(e1), a2 = glm::abs(e2);
  const glm::vec3 extents = a1 + a2 + glm::abs(a1 - a2);
  const float extent = std::max(std::max(extents.x, extents.y), extents.z);
  // 1 / extent by its exponent alone: exact, and keeps squares of the normal in range.
  const float power =
      std::bit_cast<float>((254u << 23) - (std::bit_cast<std::uint32_t>(extent) & 0x7F800000u));
  const glm::vec3 n = glm::cross(e1 * power, e2 * power);
  glm::vec3 object_error = kC0 * glm::abs(v0) + glm::vec3(kC1 * extent);

  SpawnPoint out;
  out.position = detail::rows_times_point(object_to_world, p);
  glm::vec3 world_error, world_normal;
  const glm::vec3 ap = glm::abs(p), aw = glm::abs(out.position);
  for (int r = 0; r < 3; ++r) {
    const glm::vec4 row = glm::abs(object_to_world[r]);
    world_error[r] = kC1 * (row.x * ap.x + row.y * ap.y + row.z * ap.z) + kC2 * row.w;
    const glm::vec4 back = glm::abs(world_to_object[r]);
    object_error[r] += kC2 * (back.x * aw.x + back.y * aw.y + back.z * aw.z + back.w);
    world_normal[r] =
        world_to_object[0][r] * n.x + world_to_object[1][r] * n.y + world_to_object[2][r] * n.z;
  }
  const float length_squared = glm::dot(world_normal, world_normal);
  if (!(length_squared > 0.0f)) return out;
  const float scale = 1.0f / std::sqrt(length_squared);
  out.normal = world_normal * scale;
  out.offset =
      scale * glm::dot(object_error, glm::abs(n)) + glm::dot(world_error, glm::abs(out.normal));
  return out;
}

/// Origin of a ray towards `direction`: on that side of the triangle. The ray's TMin is 0.
inline glm::vec3 spawn_origin(const SpawnPoint& point, const glm::vec3& direction) {
  const float side = glm::dot(point.normal, direction) >= 0.0f ? 1.0f : -1.0f;
  return point.position + point.normal * (side * point.offset);
}

}  // namespace kaamos::effects
