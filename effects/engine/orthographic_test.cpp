// SPDX-License-Identifier: MIT
// Orthographic cameras: what rays and draws show, where it was a frame before, and the light that
// comes from there.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kSize = 64;
constexpr double kHalfHeight = 2.0;

// Two squares of 1 m, at the left 3 m and at the right 9 m before the camera, which looks down -z
// and sees 4 m by 4 m.
Scene two_squares() {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  scene.name = "two squares";
  scene.meshes.clear();
  scene.instances.clear();
  Mesh square;
  square.name = "square";
  std::vector<Vertex> corners(4);
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i].position = glm::vec3(i % 2 == 0 ? -0.5f : 0.5f, i < 2 ? -0.5f : 0.5f, 0);
    corners[i].normal = glm::vec3(0, 0, 1);
    corners[i].tangent = glm::vec4(1, 0, 0, 1);
  }
  const std::vector<std::uint32_t> indices = {0, 1, 2, 2, 1, 3};
  square.add_geometry(corners, indices, 0, false);
  scene.meshes.push_back(square);
  for (const glm::dvec3 at : {glm::dvec3(-1, 0, -3), glm::dvec3(1, 0, -9)}) {
    Instance instance;
    instance.name = "square";
    instance.transform[3] = glm::dvec4(at, 1);
    scene.instances.push_back(instance);
  }
  Camera& camera = scene.cameras.front();
  camera.camera_to_world = glm::dmat4(1.0);
  camera.half_height = kHalfHeight;
  return scene;
}

std::unique_ptr<FrameRenderer> make_renderer(const std::string& backend, const Scene& scene,
                                             const FrameSettings& settings) {
  rtapi::DeviceDesc desc;
  desc.Backend = backend;
  desc.OnMessage = [](const rtapi::Message& m) { ADD_FAILURE() << m.Text; };
  return FrameRenderer::create(test::device_for(desc), scene, settings).value();
}

FrameSettings surfaces_alone(Primary primary, bool moving = false) {
  FrameSettings settings;
  settings.width = settings.height = kSize;
  settings.primary = primary;
  settings.moving = moving;
  settings.whole_frame = false;
  return settings;
}

class OrthographicTest : public test::OnBackends {};
INSTANTIATE_TEST_SUITE_P(Backends, OrthographicTest, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

TEST_P(OrthographicTest, SizesDoNotDependOnDistance) {
  for (const Primary primary : {Primary::kRays, Primary::kRaster}) {
    const Scene scene = two_squares();
    const auto renderer = make_renderer(GetParam(), scene, surfaces_alone(primary));
    renderer->render().value();
    const Frame& frame = renderer->frame();
    const FloatImage z = renderer->read(frame.texture(kViewZ)).value();
    const FloatImage position = renderer->read(frame.texture(kPosition)).value();
    int near = 0, far = 0;
    for (std::uint32_t y = 0; y < kSize; ++y) {
      for (std::uint32_t x = 0; x < kSize; ++x) {
        const float depth = z.at(x, y, 0);
        if (depth == 0) continue;
        (x < kSize / 2 ? near : far) += 1;
        EXPECT_NEAR(depth, x < kSize / 2 ? 3 : 9, 1e-5);
        const double metre = 2 * kHalfHeight / kSize;
        EXPECT_NEAR(position.at(x, y, 0), (x + 0.5) * metre - kHalfHeight, 1e-5);
        EXPECT_NEAR(position.at(x, y, 1), kHalfHeight - (y + 0.5) * metre, 1e-5);
      }
    }
    EXPECT_EQ(near, 16 * 16) << "1 m of 4 m is a quarter of the picture";
    EXPECT_EQ(far, 16 * 16);
  }
}

// The camera goes 0.5 m to the right and 1 m back: everything moves by the same part of the
// picture.
TEST_P(OrthographicTest, MotionIsTheSameAtEveryDistance) {
  for (const Primary primary : {Primary::kRays, Primary::kRaster}) {
    const Scene scene = two_squares();
    const auto renderer = make_renderer(GetParam(), scene, surfaces_alone(primary, true));
    FrameMoment moment;
    moment.camera = scene.cameras.front();
    for (std::uint32_t i = 0; i < 2; ++i) {
      moment.index = i;
      moment.camera.camera_to_world[3] = glm::dvec4(0.5 * i, 0, 1.0 * i, 1);
      renderer->begin_frame(moment).value();
      renderer->render().value();
    }
    const FloatImage motion = renderer->read(renderer->frame().texture(kMotion)).value();
    const FloatImage z = renderer->read(renderer->frame().texture(kViewZ)).value();
    int seen = 0;
    for (std::uint32_t i = 0; i < kSize * kSize; ++i) {
      if (z.values[i] == 0) continue;
      ++seen;
      EXPECT_NEAR(motion.values[4 * i], 0.5 / (2 * kHalfHeight), 1e-6);
      EXPECT_NEAR(motion.values[4 * i + 1], 0, 1e-6);
      EXPECT_NEAR(motion.values[4 * i + 2], -1, 1e-5);
    }
    EXPECT_EQ(seen, 2 * 16 * 16);
  }
}

// Depth pictures alone tell ambient occlusion where surfaces are: a square in the open has none.
TEST_P(OrthographicTest, ScreenSpaceTechniquesSeeFlatSquares) {
  const Scene scene = two_squares();
  FrameSettings settings;
  settings.width = settings.height = kSize;
  settings.effects.clear();
  for (const char* name : {"hemisphere-ao", "hbao", "gtao", "crytek-ao-remapped"}) {
    const Effect* row = find_effect(northlight_effects(), name);
    ASSERT_NE(row, nullptr) << name;
    settings.effects[name] = row->defaults;
    settings.effects[name].named = true;
  }
  const auto renderer = make_renderer(GetParam(), scene, settings);
  renderer->render().value();
  for (const auto& [name, ignored] : settings.effects) {
    const std::string layer = find_effect(northlight_effects(), name)->signals.front().name;
    const FloatImage open = renderer->read(layer).value();
    EXPECT_GT(open.at(kSize / 4, kSize / 2, 0), 0.9f) << name << ", near";
    EXPECT_GT(open.at(3 * kSize / 4, kSize / 2, 0), 0.9f) << name << ", far";
  }
}

TEST_P(OrthographicTest, WhatNeedsPerspectiveSaysSo) {
  Scene scene = two_squares();
  scene.cameras.front().name = "plan";
  for (const char* name : {"ssr", "ssr-blurred", "hybrid-reflections", "line-sweep-ao"}) {
    FrameSettings settings;
    settings.width = settings.height = kSize;
    settings.effects = {{name, find_effect(northlight_effects(), name)->defaults}};
    rtapi::DeviceDesc desc;
    desc.Backend = GetParam();
    const auto refused = FrameRenderer::create(test::device_for(desc), scene, settings);
    ASSERT_FALSE(refused.ok()) << name;
    EXPECT_NE(refused.error().message.find("effect \"" + std::string(name) +
                                           "\" needs a perspective camera, and \"plan\" is "
                                           "orthographic"),
              std::string::npos)
        << refused.error().message;
  }
}

}  // namespace
}  // namespace kaamos::effects
