// SPDX-License-Identifier: MIT
// A crease behind poles: with a second layer of depth it is what it would be without them, but for
// what poles far in front still darken.
#include "effects/occlusion/second_layer/second_layer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "effects/assets/scene/shapes.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/occlusion/screen_space_ao/screen_space_ao.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 96, kHeight = 54;
constexpr std::uint32_t kPoints = 64;  // of a pixel
constexpr float kRadius = 0.5f;        // metres

void add_thing(Scene& scene, const Shape& shape) {
  Mesh mesh;
  add_shape(mesh, shape, 0);
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back(instance);
}

// A floor and a wall, instances 1 and 2 of the picture; `with_poles`, such that hide half of the
// crease, two metres before it.
Scene make_crease(bool with_poles) {
  Scene scene;
  scene.name = "crease";
  Material grey;
  grey.constants.base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
  grey.constants.flags = kMaterialDoubleSided;
  scene.materials.push_back(grey);
  scene.samplers.push_back(Sampler{});
  add_thing(scene, patch({-4, 0, 4}, {8, 0, 0}, {0, 0, -4}, 1, 1));
  add_thing(scene, patch({-4, 0, 0}, {8, 0, 0}, {0, 4, 0}, 1, 1));
  for (int i = -3; with_poles && i <= 3; ++i) {
    add_thing(scene, patch({0.4 * i - 0.1, 0.0, 2.0}, {0.2, 0, 0}, {0, 2, 0}, 1, 1));
  }
  Camera camera;
  camera.camera_to_world = look_at(glm::dvec3(0, 0.8, 4), glm::dvec3(0, 0.3, 0));
  scene.cameras.push_back(camera);
  return scene;
}

// The renderer keeps a reference to the scene. `separation`: in radii.
std::unique_ptr<FrameRenderer> render(const std::string& backend, const Scene& scene,
                                      float separation = HemisphereConstants{}.separation) {
  FrameSettings settings;
  settings.width = kWidth;
  settings.height = kHeight;
  settings.effects = choose_effects({"hemisphere-ao", "hemisphere-ao-layers"});
  for (const char* name : {"hemisphere-ao", "hemisphere-ao-layers"}) {
    EffectSettings& effect = settings.effects.at(name);
    effect.keep = effect.named = true;
    effect.radius = kRadius;
    auto constants = effect.get_constants<HemisphereConstants>();
    constants.filter_passes = 0;  // it would mix poles and what is behind them
    constants.samples = kPoints;
    constants.separation = separation;
    effect.set_constants(constants);
  }
  settings.denoise = default_denoise(DenoiseMethod::kNone);
  rtapi::DeviceDesc device;
  device.Backend = backend;
  device.OnMessage = [](const rtapi::Message& m) { ADD_FAILURE() << m.Text; };
  auto renderer = FrameRenderer::create(test::device_for(device), scene, settings).value();
  renderer->render().value();
  return renderer;
}

// What is left of an occluder so far in front of a point. [hemisphere_ao.hlsl: Occlusion]
float left_of(float metres) {
  const float t = std::clamp(kRadius / metres, 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

class SecondLayers : public test::OnBackends {};

INSTANTIATE_TEST_SUITE_P(Backends, SecondLayers, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

TEST_P(SecondLayers, ACreaseGoesOnBehindPoles) {
  const Scene without = make_crease(false), with = make_crease(true);
  const auto open = render(GetParam(), without), hidden = render(GetParam(), with);
  const FloatImage ids = hidden->read("ids").value(), depth = hidden->read("view_z").value();
  const FloatImage truth = open->read("hemisphere_ao").value();
  const FloatImage one = hidden->read("hemisphere_ao").value();
  const FloatImage two = hidden->read("hemisphere_ao_layers").value();
  // Behind floor and wall is nothing.
  EXPECT_EQ(open->read("hemisphere_ao_layers").value().values, truth.values);

  float poles = 0;  // view depth of the farthest
  for (std::size_t i = 0; i < depth.values.size(); ++i) {
    if (ids.values[2 * i] > 2) poles = std::max(poles, depth.values[i]);
  }
  ASSERT_GT(poles, 1.5f);
  float brighter_one = 0, brighter_two = 0;
  int count = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const float behind = depth.at(x, y) - poles;
      // Poles hide nothing from what is farther away than the radius.
      if (ids.at(x, y, 0) == 0 || ids.at(x, y, 0) > 2 || behind < 2 * kRadius) continue;
      ++count;
      brighter_one = std::max(brighter_one, one.at(x, y) - truth.at(x, y));
      brighter_two = std::max(brighter_two, two.at(x, y) - truth.at(x, y));
      // All points may be behind poles, at most.
      ASSERT_GE(two.at(x, y), truth.at(x, y) - left_of(behind) - 1.5f / kPoints) << x << ' ' << y;
    }
  }
  std::printf("%s: %d pixels, brighter by %.3f with one layer, %.3f with two\n", GetParam().c_str(),
              count, brighter_one, brighter_two);
  ASSERT_GT(count, 500);
  EXPECT_GT(brighter_one, 4.5f / kPoints);
  // A draw rounds depth in another way than a ray: a point on the surface may change its side.
  EXPECT_LT(brighter_two, 1.5f / kPoints);
}

// What is nearer than the separation to the first surface is part of it, so that far apart layers
// are one.
TEST_P(SecondLayers, ALayerThatIsFartherThanTheWallIsNone) {
  const Scene scene = make_crease(true);
  const auto renderer = render(GetParam(), scene, 20.0f);
  EXPECT_EQ(renderer->read("hemisphere_ao_layers").value().values,
            renderer->read("hemisphere_ao").value().values);
}

}  // namespace
}  // namespace kaamos::effects
