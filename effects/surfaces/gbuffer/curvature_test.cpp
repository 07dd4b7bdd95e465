// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/northlight/frame_renderer.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kSize = 65;
constexpr double kDistance = 6, kFieldOfView = 0.3;

FloatImage material_of(bool curvature) {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  scene.materials[0].constants.roughness = 0;
  scene.cameras.front().camera_to_world =
      look_at(glm::dvec3(0, 1.5 + kDistance, 0), glm::dvec3(0, 1.5, 0));
  scene.cameras.front().vertical_fov = kFieldOfView;
  FrameSettings settings;
  settings.width = settings.height = kSize;
  settings.whole_frame = false;
  settings.curvature_to_roughness = curvature;
  const auto renderer =
      FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  renderer->render().value();
  return renderer->read("material").value();
}

// In the middle of a mirror ball each pixel turns the normal by the pixel's size over the radius.
TEST(Curvature, MakesAMirrorBallAsRoughAsItsNormalsVary) {
  const double pixel = 2 * std::tan(0.5 * kFieldOfView) / kSize * (kDistance - 1);
  const double wanted = std::pow(2 * 0.25 * 2 * pixel * pixel, 0.25);
  const FloatImage curved = material_of(true), plain = material_of(false);
  EXPECT_EQ(plain.at(kSize / 2, kSize / 2, 0), 0);
  EXPECT_NEAR(curved.at(kSize / 2, kSize / 2, 0), wanted, 0.1 * wanted + 1 / 255.0);
  EXPECT_GT(wanted, 0.05);
  EXPECT_EQ(curved.at(1, 1, 0), 0) << "the flat floor stays a mirror";
}

}  // namespace
}  // namespace kaamos::effects
