// SPDX-License-Identifier: MIT
// Baked ambient occlusion before a wall, against the closed form, and what it misses.
#include "effects/occlusion/baked_ao/baked_ao.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <set>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/scene/shapes.h"
#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 64, kHeight = 36;
constexpr float kRadius = 1.0f;  // metres
constexpr BakedAoConstants kFine = {.rays = 256};
constexpr std::uint32_t kFloor = 1, kWall = 2, kBox = 3;  // instances in the picture

Instance instance_of(Scene& scene, Mesh mesh) {
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back(std::move(mesh));
  return instance;
}

// A floor before a wall; both end farther away than rays reach from what is seen. The wall is a
// mesh of two geometries, whose triangles have the same numbers.
Scene make_corner() {
  Scene scene;
  scene.name = "corner";
  Material grey;
  grey.constants.base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
  scene.materials.push_back(grey);
  scene.samplers.push_back(Sampler{});
  Mesh floor, wall;
  add_shape(floor, patch({0, 0, 4}, {4, 0, 0}, {0, 0, -8}, 1, 1), 0);
  add_shape(wall, patch({0, 0, 4}, {0, 0, -8}, {0, 0.5, 0}, 1, 1), 0);
  add_shape(wall, patch({0, 0.5, 4}, {0, 0, -8}, {0, 2.5, 0}, 1, 1), 0);
  scene.instances.push_back(instance_of(scene, std::move(floor)));
  scene.instances.push_back(instance_of(scene, std::move(wall)));
  Camera camera;
  camera.camera_to_world = look_at(glm::dvec3(2, 1.2, 0), glm::dvec3(0.3, 0.3, 0));
  camera.vertical_fov = 0.7;
  scene.cameras.push_back(camera);
  return scene;
}

// A box of 0.3 m on the floor; one that `moves` is no part of the bake, at rest as it may be.
void add_box(Scene& scene, bool moves) {
  Mesh mesh;
  add_shape(mesh, box(glm::dvec3(0.15)), 0);
  Instance instance = instance_of(scene, std::move(mesh));
  instance.transform = glm::translate(glm::dmat4(1.0), {0.8, 0.15, 0});
  if (moves) {
    instance.motion.node = static_cast<std::int32_t>(scene.nodes.size());
    scene.nodes.push_back({.name = "box"});
  }
  scene.instances.push_back(instance);
}

// The renderer keeps a reference to the scene.
rtapi::Result<std::unique_ptr<FrameRenderer>> try_render(const std::string& backend,
                                                         const Scene& scene,
                                                         const BakedAoConstants& constants) {
  FrameSettings settings;
  settings.width = kWidth;
  settings.height = kHeight;
  settings.effects = choose_effects({"ao", "baked-ao"});
  for (const char* name : {"ao", "baked-ao"}) {
    EffectSettings& effect = settings.effects.at(name);
    effect.keep = effect.named = true;
    effect.radius = kRadius;
  }
  settings.effects.at("ao").samples = 256;
  settings.effects.at("baked-ao").set_constants(constants);
  settings.denoise = default_denoise(DenoiseMethod::kNone);
  rtapi::DeviceDesc device;
  device.Backend = backend;
  device.OnMessage = [](const rtapi::Message& m) { ADD_FAILURE() << m.Text; };
  auto renderer = FrameRenderer::create(test::device_for(device), scene, settings);
  if (!renderer) return renderer.error();
  if (const auto rendered = (*renderer)->render(); !rendered) return rendered.error();
  return renderer;
}
std::unique_ptr<FrameRenderer> render(const std::string& backend, const Scene& scene,
                                      const BakedAoConstants& constants = kFine) {
  return try_render(backend, scene, constants).value();
}

// The error of baked visibility in the corner.
double root_mean_square(FrameRenderer& renderer, const Scene& scene) {
  const FloatImage seen = renderer.read("baked_ao").value();
  const FloatImage ids = renderer.read("ids").value();
  const FloatImage position = renderer.read("position").value();
  const glm::dvec3 eye = scene.cameras.front().position();
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < std::size_t{kWidth} * kHeight; ++i) {
    const auto instance = static_cast<std::uint32_t>(ids.values[2 * i]);
    if (instance != kFloor && instance != kWall) continue;
    // To the other plane.
    const double away =
        instance == kFloor ? eye.x + position.values[4 * i] : eye.y + position.values[4 * i + 1];
    const double truth = 1 - wall_occlusion_bounded(kRadius, away);
    sum += std::pow(seen.values[seen.channels * i] - truth, 2);
    ++count;
  }
  EXPECT_GT(count, 1500);
  return std::sqrt(sum / count);
}

class BakedAo : public test::OnBackends {};

INSTANTIATE_TEST_SUITE_P(Backends, BakedAo, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

// The closed form is straight at the crease, 2 / pi a metre, and texels on edges are moved inwards
// by a tenth of their width: 0.006. 256 random directions would be off by 1 / 32 where half is
// open; those of a sequence by less than half of that.
TEST_P(BakedAo, ACornerIsThatOfTheClosedForm) {
  const Scene scene = make_corner();
  EXPECT_LT(root_mean_square(*render(GetParam(), scene), scene), 0.016);
  // Between the corners of the planes alone there is no crease.
  const auto coarse = render(GetParam(), scene, {.texel = 8.0f, .rays = 256});
  EXPECT_GT(root_mean_square(*coarse, scene), 0.03);
}

TEST_P(BakedAo, AnotherRadiusBakesAnew) {
  const Scene scene = make_corner();
  const auto renderer = render(GetParam(), scene);
  const FloatImage before = renderer->read("baked_ao").value();
  EffectSettings settings{.radius = 0};
  settings.set_constants(kFine);
  renderer->run("baked-ao", settings).value();
  for (const float v : renderer->read("baked_ao").value().values) ASSERT_EQ(v, 1);
  settings.radius = kRadius;
  renderer->run("baked-ao", settings).value();
  EXPECT_EQ(renderer->read("baked_ao").value().values, before.values);
}

// What stands still darkens the floor around it, and is darkened; what may move does neither.
TEST_P(BakedAo, WhatMovesIsMissed) {
  const Scene empty = make_corner();
  Scene still = make_corner(), moving = make_corner();
  add_box(still, false);
  add_box(moving, true);
  const auto of_empty = render(GetParam(), empty), of_still = render(GetParam(), still),
             of_moving = render(GetParam(), moving);
  const FloatImage alone = of_empty->read("baked_ao").value();
  const FloatImage beside = of_still->read("baked_ao").value();
  const FloatImage missed = of_moving->read("baked_ao").value();
  const FloatImage rays = of_moving->read("ao").value();
  const FloatImage ids = of_moving->read("ids").value();
  float darkest_still = 0, darkest_rays = 0;
  int on_box = 0;
  for (std::size_t i = 0; i < std::size_t{kWidth} * kHeight; ++i) {
    const auto seen = static_cast<std::uint32_t>(ids.values[2 * i]);
    if (seen == kBox) {
      ASSERT_EQ(missed.values[4 * i], 1);
      ++on_box;
    }
    if (seen != kFloor && seen != kWall) continue;
    ASSERT_EQ(missed.values[4 * i], alone.values[4 * i]);
    darkest_still = std::max(darkest_still, alone.values[4 * i] - beside.values[4 * i]);
    darkest_rays = std::max(darkest_rays, missed.values[4 * i] - rays.values[rays.channels * i]);
  }
  EXPECT_GT(on_box, 20);
  // A wall hides half of what stands at its foot; a texel beside it a little less.
  EXPECT_GT(darkest_still, 0.2f);
  EXPECT_GT(darkest_rays, 0.2f);
}

TEST(BakedAoTexels, AnEdgeHasSoManyParts) {
  EXPECT_EQ(baked_cells(0.04, 0.1), 0u);
  EXPECT_EQ(baked_cells(0.06, 0.1), 1u);
  EXPECT_EQ(baked_cells(1.0, 0.1), 10u);
  EXPECT_EQ(baked_cells(1e9, 0.1), 1024u);
  EXPECT_EQ(baked_cells(std::numeric_limits<double>::quiet_NaN(), 0.1), 0u);
  EXPECT_EQ(baked_cells(std::numeric_limits<double>::infinity(), 0.1), 1024u);
}

// One texel for each of 6 triangles is as coarse as it gets.
TEST(BakedAoTexels, ASceneKeepsToItsMost) {
  const Scene scene = make_corner();
  const auto few = render("embree", scene, {.rays = 4, .most_texels = 1});
  const FloatImage seen = few->read("baked_ao").value();
  std::set<float> values;
  for (std::size_t i = 0; i < seen.values.size(); i += 4) values.insert(seen.values[i]);
  EXPECT_LE(values.size(), 7u) << "6 triangles, and the sky";
}

TEST(BakedAoTexels, ATexelThatIsNoLengthIsRefused) {
  const Scene scene = make_corner();
  for (const float texel : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
    const auto refused = try_render("embree", scene, {.texel = texel});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("BakedAoConstants::texel"), std::string::npos)
        << refused.error().message;
  }
}

}  // namespace
}  // namespace kaamos::effects
