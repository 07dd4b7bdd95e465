// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/stress_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/assets/built_in/camera_paths.h"

namespace kaamos::effects {
namespace {

constexpr StressKind kKinds[] = {StressKind::kPub, StressKind::kResort, StressKind::kBreakfast};

TEST(StressScenes, HaveTheTrianglesOfTheOriginals) {
  for (const StressKind kind : kKinds) {
    for (const double scale : {1.0 / 32, 0.1, 1.0}) {
      const Scene scene = make_stress_scene({.kind = kind, .scale = scale});
      const double wanted = scale * static_cast<double>(original_triangles(kind));
      EXPECT_NEAR(static_cast<double>(instanced_triangle_count(scene)), wanted, 0.01 * wanted)
          << scene.name << " " << scale;
      EXPECT_GT(scene.instances.size(), 40u);
      EXPECT_LT(unique_triangle_count(scene), 100000u);
    }
  }
}

TEST(StressScenes, HaveOneLightOrFour) {
  for (const StressKind kind : kKinds) {
    for (const std::uint32_t lights : {1u, 4u}) {
      const Scene scene = make_stress_scene({.kind = kind, .lights = lights});
      EXPECT_EQ(scene.lights.size() + (scene.sun ? 1 : 0), lights) << scene.name;
      EXPECT_EQ(scene.sun.has_value(), kind == StressKind::kResort);
      for (const Light& light : scene.lights) EXPECT_GE(light.radius, 0.2f);
    }
  }
}

// The way begins at the first camera, takes 20 seconds, makes no jump and stays in the rooms.
TEST(StressScenes, HaveAWayOfTwentySeconds) {
  for (const StressKind kind : kKinds) {
    const Scene scene = make_stress_scene({.kind = kind});
    const CameraPath path = make_camera_path(scene, "").value();
    EXPECT_EQ(path.name, "own");
    EXPECT_EQ(path.keys.back().seconds, 20.0);
    const Camera& first = scene.cameras.front();
    glm::dvec3 before = first.position();
    for (int i = 0; i <= 600; ++i) {
      const glm::dvec3 at = evaluate_camera(path, first, i / 30.0).position();
      EXPECT_LT(glm::distance(at, before), i == 0 ? 1e-9 : 0.12) << scene.name << " " << i;
      EXPECT_GT(at.y, 0.2);
      if (kind == StressKind::kPub) {
        EXPECT_LT(std::abs(at.x), 5.9);
        EXPECT_LT(std::abs(at.z), 3.9);
      }
      before = at;
    }
  }
  Scene other = make_stress_scene({});
  other.name = "shed";
  EXPECT_FALSE(make_camera_path(other, "own").ok());
}

}  // namespace
}  // namespace kaamos::effects
