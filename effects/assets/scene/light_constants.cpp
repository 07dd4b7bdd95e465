// SPDX-License-Identifier: MIT
#include "effects/assets/scene/light_constants.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "effects/assets/common/sampling.h"

namespace kaamos::effects {

namespace {

// More than the sun as a point light (3e27 cd). Up to this, the square of a range is still a float.
constexpr float kStrongestIntensity = 1e30f;

// The least radius relative to the range, so that a light without a radius is not infinite at its
// own position. Where a scene gives no range, the range is where 1e-3 lux arrive, so the limit is
// 1e11 lux.
constexpr float kLeastRadius = 1e-7f;

bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_whole(const LightConstants& light) {
  return is_finite(light.position) && is_finite(light.intensity) && is_finite(light.direction) &&
         std::isfinite(light.radius) && std::isfinite(light.spot_scale) &&
         std::isfinite(light.spot_offset);
}

// Turns a light dark if a broken number would make it shine everywhere, or as NaN. It stays in the
// list, because shadow maps are found by the light's index.
void darken(LightConstants& light) {
  light.position = light.intensity = glm::vec3(0.0f);
  light.direction = glm::vec3(0, -1, 0);
  light.radius = 0;
  light.range = 1;
  light.is_spot = 0;
  light.spot_scale = 0;
  light.spot_offset = light.cos_outer = 1;
}

// [KHR_lights_punctual: Inner and Outer Cone Angles]
void set_cone(LightConstants& out, const Light& light) {
  const float inner = std::cos(light.inner_cone_angle);
  const float outer = std::cos(light.outer_cone_angle);
  out.spot_scale = 1.0f / std::max(1e-3f, inner - outer);
  out.spot_offset = -outer * out.spot_scale;
  out.is_spot = 1;
  out.cos_outer = std::max(outer, 0.05f);  // a flat map cannot cover a half space
}

// Computes what follows from the rest, so that shaders need not compute it at every point.
void derive(LightConstants& light, const glm::vec3& up) {
  constexpr float kLeast = std::numeric_limits<float>::min();  // 1 / kLeast is still a float
  light.over_range = 1.0f / std::max(light.range, kLeast);
  light.over_least_distance = 1.0f / std::max({light.radius, kLeastRadius * light.range, kLeast});
  if (light.is_spot == 0) {
    // An octahedral map covers 4 pi with its texels; a single texel differs from the mean by up to
    // two times.
    light.map_texel = std::sqrt(4.0f * std::numbers::pi_v<float>) / kShadowTile;
    return;
  }
  const float cosine = light.cos_outer;
  const float tangent = std::max(std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)) / cosine, 1e-6f);
  const glm::vec3 right = glm::cross(light.direction, up);
  const float length = glm::length(right);
  if (length > 1e-3f) {
    light.map_right = right / (length * tangent);
    light.map_up = glm::cross(light.map_right, light.direction);
  } else {
    light.map_right = to_world({1, 0, 0}, light.direction) / tangent;
    light.map_up = glm::cross(light.direction, light.map_right);
  }
  light.map_texel = 2.0f * tangent / kShadowTile;
}

}  // namespace

std::vector<LightConstants> light_constants(const Scene& scene, const glm::dvec3& origin) {
  std::vector<LightConstants> lights;
  for (const Light& light : scene.lights) {
    if (light.type == LightType::kDirectional) continue;
    LightConstants out = {};
    out.position = glm::vec3(light.position - origin);
    out.intensity = light.color * light.intensity;
    if (is_finite(light.color) && std::isfinite(light.intensity)) {
      out.intensity = glm::min(out.intensity, glm::vec3(kStrongestIntensity));
    }
    out.direction = light.direction;
    out.radius = std::isfinite(light.radius) ? std::max(light.radius, 0.0f) : light.radius;
    const float strongest =
        std::max({out.intensity.x, out.intensity.y, out.intensity.z, kCutOffIlluminance});
    // At the strongest intensity, strongest / cut-off is still a float.
    out.range = light.range > 0 && std::isfinite(light.range)
                    ? light.range
                    : std::sqrt(strongest / kCutOffIlluminance);
    out.spot_offset = 1.0f;
    out.projection = -1;
    if (light.projection) {
      out.projection = static_cast<std::int32_t>(light.projection->image);
      out.projection_sampler = light.projection->sampler;
    }
    if (light.type == LightType::kSpot) set_cone(out, light);
    if (!is_whole(out)) darken(out);
    derive(out, light.projection ? light.projection->up : glm::vec3(0.0f));
    lights.push_back(out);
  }
  return lights;
}

AtlasLayout atlas_layout(std::uint32_t light_count, std::uint32_t sun_map) {
  AtlasLayout out;
  const std::uint32_t columns = std::clamp<std::uint32_t>(light_count, 1, kShadowTilesPerRow);
  const std::uint32_t rows =
      std::max<std::uint32_t>((light_count + kShadowTilesPerRow - 1) / kShadowTilesPerRow, 1);
  out.tile_width = columns * kShadowTile;
  out.tile_height = rows * kShadowTile;
  out.sun = sun_map;
  out.width = out.tile_width + sun_map;
  out.height = std::max(out.tile_height, sun_map);
  return out;
}

SunMapConstants sun_map_constants(const Bounds& bounds, const glm::vec3& direction_to_sun,
                                  std::uint32_t size, const glm::dvec3& origin) {
  SunMapConstants out;
  const glm::vec3 right = to_world({1, 0, 0}, direction_to_sun);
  const glm::vec3 up = glm::cross(direction_to_sun, right);
  const glm::dvec3 centre = 0.5 * (bounds.min + bounds.max);
  const glm::dvec3 half = 0.5 * (bounds.max - bounds.min);
  const auto extent = [&](const glm::vec3& axis) {
    return glm::dot(glm::abs(glm::dvec3(axis)), half);
  };
  // A little more than all of it: what lies on the boundary is seen too.
  const double side = std::max({1.001 * extent(right), 1.001 * extent(up), 1e-30});
  out.centre = glm::vec3(centre - origin);
  out.reach = static_cast<float>(1.001 * extent(direction_to_sun) + 1e-3 * side);
  out.right = right / static_cast<float>(side);
  out.up = up / static_cast<float>(side);
  out.texel = static_cast<float>(2 * side / size);
  out.size = size;
  return out;
}

}  // namespace kaamos::effects
