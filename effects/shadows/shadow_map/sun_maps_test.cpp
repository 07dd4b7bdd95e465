// SPDX-License-Identifier: MIT
// Tests where the sun's shadow maps lie, and where their filters' taps are.
#include "effects/shadows/shadow_map/sun_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "effects/shadows/shadow_map/disk_points.h"

namespace kaamos::effects {
namespace {

SunMapsDesc a_desc() {
  SunMapsDesc desc;
  desc.direction_to_sun = glm::normalize(glm::dvec3(0.6, 0.5, -0.3));
  desc.bounds.add({-20, -1, -35});
  desc.bounds.add({30, 12, 25});
  desc.size = 512;
  desc.aspect = 16.0 / 9.0;
  return desc;
}

Camera a_camera(const glm::dvec3& eye, const glm::dvec3& target) {
  Camera camera;
  camera.camera_to_world = look_at(eye, target);
  return camera;
}

glm::dvec3 in_map(const SunMap& map, const Camera& camera, const glm::dvec3& point) {
  const glm::dvec4 p(point - camera.position(), 1.0);
  return {glm::dot(glm::dvec4(map.to_map[0]), p), glm::dot(glm::dvec4(map.to_map[1]), p),
          glm::dot(glm::dvec4(map.to_map[2]), p)};
}

TEST(SunMaps, OneMapHoldsTheScene) {
  const SunMapsDesc desc = a_desc();
  const Camera camera = a_camera({3, 2, 1}, {0, 1, -4});
  const auto maps = sun_maps(desc, camera);
  ASSERT_EQ(maps.size(), 1u);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) ? 30 : -20, (i & 2) ? 12 : -1, (i & 4) ? 25 : -35);
    const glm::dvec3 at = in_map(maps[0], camera, corner);
    EXPECT_GE(std::min(at.x, at.y), 0.0);
    EXPECT_LE(std::max(at.x, at.y), 512.0);
    EXPECT_GT(at.z, 0.0);
    EXPECT_LT(at.z, maps[0].range);
  }
  // Towards the sun depth goes down, by metres, and nothing else changes.
  const glm::dvec3 p(1, 2, 3);
  const glm::dvec3 a = in_map(maps[0], camera, p);
  const glm::dvec3 b = in_map(maps[0], camera, p + 2.0 * desc.direction_to_sun);
  EXPECT_NEAR(b.z - a.z, -2.0, 1e-5);
  EXPECT_NEAR(b.x, a.x, 1e-3);
  EXPECT_NEAR(b.y, a.y, 1e-3);
}

TEST(SunMaps, SplitsGoFromEvenToLogarithmic) {
  EXPECT_NEAR(cascade_split(1, 16, 1, 2, 4), 4.0, 1e-12);
  EXPECT_NEAR(cascade_split(1, 16, 0, 2, 4), 8.5, 1e-12);
  EXPECT_NEAR(cascade_split(1, 16, 0.75, 2, 4), 5.125, 1e-12);
  EXPECT_NEAR(cascade_split(0.1, 40, 0.75, 4, 4), 40.0, 1e-12);
}

// Wherever the camera goes and looks, a point of the world stays at its place within a texel.
TEST(SunMaps, StableCascadesKeepTheirTexels) {
  SunMapsDesc desc = a_desc();
  desc.cascades = 4;
  desc.reach = 30;
  const glm::dvec3 point(1.3, 0.2, -2.7);
  for (const bool stable : {true, false}) {
    desc.stable = stable;
    double moved = 0;
    const Camera first = a_camera({3, 2, 1}, {0, 1, -4});
    const auto maps = sun_maps(desc, first);
    for (int i = 1; i < 20; ++i) {
      const Camera camera = a_camera({3 + 0.013 * i, 2, 1 - 0.017 * i}, {0.05 * i, 1, -4});
      const auto next = sun_maps(desc, camera);
      for (std::size_t c = 0; c < maps.size(); ++c) {
        const glm::dvec3 off = in_map(next[c], camera, point) - in_map(maps[c], first, point);
        moved = std::max(moved, std::abs(off.x - std::round(off.x)));
        moved = std::max(moved, std::abs(off.y - std::round(off.y)));
      }
    }
    if (stable) {
      EXPECT_LT(moved, 0.01);
    } else {
      EXPECT_GT(moved, 0.2);
    }
  }
}

// The slice that a cascade is used for lies in it, whichever way the camera looks.
TEST(SunMaps, CascadesHoldTheirSlices) {
  SunMapsDesc desc = a_desc();
  desc.cascades = 3;
  for (const bool stable : {true, false}) {
    desc.stable = stable;
    for (const glm::dvec3& target : {glm::dvec3(0, 1, -4), {4, 9, 1}, {-8, 0, 7}}) {
      const Camera camera = a_camera({3, 2, 1}, target);
      double begin = 0;
      for (const SunMap& map : sun_maps(desc, camera)) {
        const double up = std::tan(0.5 * camera.vertical_fov), right = up * desc.aspect;
        for (int i = 0; i < 8; ++i) {
          const double z = (i & 4) ? map.end : begin;
          const glm::dvec4 corner((i & 1) ? z * right : -z * right, (i & 2) ? z * up : -z * up, -z,
                                  1);
          const glm::dvec3 at = in_map(map, camera, glm::dvec3(camera.camera_to_world * corner));
          EXPECT_GE(std::min(at.x, at.y), -1e-3);
          EXPECT_LE(std::max(at.x, at.y), desc.size + 1e-3);
        }
        begin = map.end;
      }
    }
  }
}

TEST(DiskPoints, FirstOnesKeepAwayFromEachOther) {
  const auto points = disk_points(64);
  for (const glm::vec2& p : points) EXPECT_LE(glm::length(p), 1.0f);
  for (const std::size_t count : {4u, 16u, 36u, 64u}) {
    float nearest = 4;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        nearest = std::min(nearest, glm::distance(points[i], points[k]));
      }
    }
    // Half of what a hexagonal lattice of as many discs in the circle has.
    EXPECT_GT(nearest, 0.5 * 1.9 / std::sqrt(static_cast<double>(count))) << count;
  }
}

}  // namespace
}  // namespace kaamos::effects
