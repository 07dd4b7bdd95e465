// SPDX-License-Identifier: MIT
#include "effects/engine/frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/scene/checkers_fixture.h"
#include "effects/northlight/frame_renderer.h"

namespace kaamos::effects {
namespace {

// A plane with a texture of black and white texels, 64 per metre, seen from so high above that a
// pixel covers dozens of them.
Scene checkered_plane() {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  scene.instances.resize(1);
  scene.images.push_back(make_checkers());
  scene.samplers.resize(1);
  for (Material& material : scene.materials) {
    material.constants.base_color = glm::vec4(1);
    material.constants.image[kBaseColorTexture] = 0;
  }
  for (Vertex& vertex : scene.meshes[scene.instances[0].mesh].vertices) {
    vertex.uv = glm::vec2(vertex.position.x, vertex.position.z);
  }
  Camera& camera = scene.cameras.front();
  camera.camera_to_world = look_at(glm::dvec3(0.1, 40, 0.2), glm::dvec3(0));
  camera.vertical_fov = 0.5;
  return scene;
}

FloatImage base_colors(const Scene& scene, bool ray_cones) {
  FrameSettings settings;
  settings.width = settings.height = 32;
  settings.ray_cones = ray_cones;
  settings.whole_frame = false;
  const auto renderer =
      FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  renderer->render().value();
  return renderer->read(renderer->frame().texture(kBaseColor)).value();
}

// Mean and standard deviation of the base colour as stored.
struct Spread {
  double mean = 0, deviation = 0;
};
Spread spread_of(const FloatImage& picture) {
  const double count = picture.width * picture.height;
  Spread out;
  for (std::size_t i = 0; i < picture.values.size(); i += 4) out.mean += picture.values[i] / count;
  for (std::size_t i = 0; i < picture.values.size(); i += 4) {
    out.deviation += std::pow(picture.values[i] - out.mean, 2) / count;
  }
  out.deviation = std::sqrt(out.deviation);
  return out;
}

TEST(Frame, RayConesChooseTheLevelOfTextures) {
  const Scene scene = checkered_plane();
  const Spread cones = spread_of(base_colors(scene, true));
  const Spread level_zero = spread_of(base_colors(scene, false));
  EXPECT_LT(cones.deviation, 0.02) << "many texels in a pixel are one colour";
  EXPECT_GT(level_zero.deviation, 0.1) << "level 0 picks a few of them";
}

// Base colours are stored as the byte nearest to their square root.
// [effects/shaders/encoding.hlsli]
TEST(Frame, BaseColorsAreStoredBySquareRoots) {
  Scene scene = checkered_plane();
  const glm::vec3 color(0.25f, 0.001f, 1.0f);
  for (Material& material : scene.materials) {
    material.constants.base_color = glm::vec4(color, 1);
    material.constants.image[kBaseColorTexture] = -1;
  }
  const FloatImage picture = base_colors(scene, true);
  for (std::uint32_t c = 0; c < 3; ++c) {
    const float stored = picture.at(16, 16, c);
    EXPECT_NEAR(stored, std::sqrt(color[static_cast<int>(c)]), 0.5001f / 255) << c;
  }
}

// E1: the survey's ray through a pixel lacks a -1 in its vertical part, -f (2 (y + 1/2) / h): its
// middle row looks down by half the field of view. [effects/SOURCES.md]
TEST(Frame, TheMiddlePixelLooksStraightAhead) {
  Scene scene = checkered_plane();
  const Camera& camera = scene.cameras.front();
  constexpr std::uint32_t kWidth = 33, kHeight = 21;
  FrameSettings settings;
  settings.width = kWidth;
  settings.height = kHeight;
  settings.whole_frame = false;
  const auto renderer =
      FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  renderer->render().value();
  const FloatImage position = renderer->read(renderer->frame().texture(kPosition)).value();
  const double f = std::tan(camera.vertical_fov / 2);
  const double aspect = static_cast<double>(kWidth) / kHeight;
  const glm::dmat3 axes(camera.camera_to_world);
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const glm::dvec3 at(position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2));
      const glm::dvec3 ray = at / -glm::dot(at, axes[2]);
      const double right = aspect * f * (2 * (x + 0.5) / kWidth - 1);
      const double up = -f * (2 * (y + 0.5) / kHeight - 1);
      ASSERT_NEAR(glm::dot(ray, axes[0]), right, 1e-5) << x << ", " << y;
      ASSERT_NEAR(glm::dot(ray, axes[1]), up, 1e-5) << x << ", " << y;
      const double survey = -f * (2 * (y + 0.5) / kHeight);
      ASSERT_NEAR(glm::dot(ray, axes[1]) - survey, f, 1e-5) << "all of it too low";
    }
  }
}

}  // namespace
}  // namespace kaamos::effects
