// SPDX-License-Identifier: MIT
#include "effects/engine/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

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

FloatImage base_colors(const Scene& scene, bool ray_cones, Primary primary = Primary::kRays) {
  FrameSettings settings;
  settings.primary = primary;
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

// A white plane whose vertices all have that colour.
Scene colored_plane(const VertexColor& color) {
  Scene scene = checkered_plane();
  for (Material& material : scene.materials) material.constants.image[kBaseColorTexture] = -1;
  Mesh& mesh = scene.meshes[scene.instances[0].mesh];
  mesh.colors.assign(mesh.vertices.size(), color);
  return scene;
}

TEST(Frame, VertexColorsMultiplyTheBaseColor) {
  Scene scene = colored_plane({16384, 32768, 65535, 65535});
  for (Material& material : scene.materials)
    material.constants.base_color = glm::vec4(1, 0.5f, 0.25f, 1);
  for (const Primary primary : {Primary::kRays, Primary::kRaster}) {
    const FloatImage picture = base_colors(scene, true, primary);
    for (std::uint32_t c = 0; c < 3; ++c)
      EXPECT_NEAR(picture.at(16, 16, c), 0.5f, 0.5001f / 255) << c;
  }
}

// The opacity of the vertices counts where the material has holes, for rays and draws alike.
TEST(Frame, VertexColorsMakeHoles) {
  for (const std::uint16_t alpha : {std::uint16_t{16384}, std::uint16_t{49152}}) {
    Scene scene = colored_plane({65535, 65535, 65535, alpha});
    for (Material& material : scene.materials)
      material.constants.flags |= kMaterialMask | kMaterialAlphaTested;
    for (Mesh& mesh : scene.meshes)
      for (Geometry& geometry : mesh.geometries) geometry.alpha_tested = true;
    for (const Primary primary : {Primary::kRays, Primary::kRaster})
      EXPECT_EQ(base_colors(scene, true, primary).at(16, 16, 0), alpha > 32768 ? 1.0f : 0.0f);
  }
}

// An unlit surface shows its base colour, whatever the light and the exposure, and mirrors nothing.
TEST(Frame, UnlitSurfacesShowTheirBaseColor) {
  Scene scene = colored_plane({65535, 32768, 65535, 65535});
  for (Material& material : scene.materials) {
    material.constants.base_color = glm::vec4(0.5f, 0.5f, 1, 1);
    material.constants.flags |= kMaterialUnlit;
  }
  scene.sky = {glm::vec3(3), glm::vec3(3), glm::vec3(3)};
  scene.sun = Sun{};
  scene.exposure = 2;
  FrameSettings settings;
  settings.width = settings.height = 16;
  settings.effects = choose_effects({"sun", "reflections"});
  settings.volume.given = std::make_shared<IndirectVolume>();
  const auto renderer =
      FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  renderer->render().value();
  const FloatImage radiance = renderer->read("radiance").value();
  EXPECT_NEAR(radiance.at(8, 8, 0), 0.25f, 1e-3f);
  EXPECT_NEAR(radiance.at(8, 8, 1), 0.125f, 1e-3f);
  EXPECT_NEAR(radiance.at(8, 8, 2), 0.5f, 1e-3f);
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
