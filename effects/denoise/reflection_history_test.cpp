// SPDX-License-Identifier: MIT
// The history of a reflection follows the image of what is reflected, not the surface.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/scene/shapes.h"
#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 96, kHeight = 40;

// A polished floor mirrors bright posts before a dark wall, some metres away.
Scene posts(float roughness) {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  scene.instances.resize(1);
  scene.sky.zenith = scene.sky.horizon = scene.sky.ground = glm::vec3(0.0f);
  scene.sun.reset();
  scene.materials[0].constants.base_color = glm::vec4(1);
  scene.materials[0].constants.metallic = 1;
  scene.materials[0].constants.roughness = roughness;
  Material dark = scene.materials[0];
  dark.constants.metallic = 0;
  dark.constants.roughness = 1;
  dark.constants.base_color = glm::vec4(0, 0, 0, 1);
  Material bright = dark;
  bright.constants.emissive = glm::vec3(1);
  scene.materials.push_back(bright);
  scene.materials.push_back(dark);
  Mesh mesh;
  Shape shape, wall;
  for (int i = -8; i <= 8; ++i) {
    append(shape, box({0.25, 4, 0.05}), translate({1.0 * i, 5, -6}));
  }
  append(wall, box({20, 4, 0.01}), translate({0, 5, -6}));
  add_shape(mesh, shape, 1);
  add_shape(mesh, wall, 2);
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back(mesh);
  scene.instances.push_back(instance);
  return scene;
}

// Root of the mean squared error of the floor's reflection after eight frames in which the camera
// moved sideways by `step` metres each, against many samples of the last.
double error_after_eight_frames(const std::string& backend, const Scene& scene, double step) {
  FrameSettings settings;
  settings.width = kWidth;
  settings.height = kHeight;
  settings.moving = true;
  settings.effects = choose_effects({"reflections"});
  settings.denoise = default_denoise(DenoiseMethod::kTemporal);
  settings.volume.given = std::make_shared<IndirectVolume>();
  rtapi::DeviceDesc device;
  device.Backend = backend;
  const auto renderer = FrameRenderer::create(test::device_for(device), scene, settings).value();
  for (std::uint32_t i = 0; i < 8; ++i) {
    Camera camera = scene.cameras.front();
    const glm::dvec3 eye(step * i, 1.2, 0);
    camera.camera_to_world = look_at(eye, eye + glm::dvec3(0, -0.75, -1.5));
    camera.vertical_fov = 0.5;
    renderer->begin_frame({.index = i, .camera = camera, .cut = i == 0}).value();
    renderer->render().value();
  }
  const FloatImage filtered = renderer->read("reflection_denoised").value();
  constexpr std::uint32_t kSamples = 256;
  renderer->run("reflections", kSamples).value();
  const FloatImage sum = renderer->read(renderer->effects().sum("reflection")).value();
  double squares = 0;
  for (std::size_t i = 0; i < sum.values.size(); i += 4) {
    squares += std::pow(filtered.values[i] - sum.values[i] / kSamples, 2);
  }
  return std::sqrt(squares / (kWidth * kHeight));
}

class ReflectionHistory : public test::OnBackends {};

TEST_P(ReflectionHistory, FollowsTheMirroredImage) {
  for (const float roughness : {0.08f, 0.2f}) {
    const Scene scene = posts(roughness);
    const double still = error_after_eight_frames(GetParam(), scene, 0);
    const double moving = error_after_eight_frames(GetParam(), scene, 0.1);
    std::printf("roughness %.2f: error %.4f at rest, %.4f in motion\n", roughness, still, moving);
    // Edges blur, because the history is read between pixels. A history that follows the floor
    // instead has errors of 0.24 and more.
    EXPECT_LT(moving, still + 0.08) << "roughness " << roughness;
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, ReflectionHistory, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

}  // namespace
}  // namespace kaamos::effects
