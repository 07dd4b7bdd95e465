// SPDX-License-Identifier: MIT
// A lamp is met once: mirrors show its shape, all other surfaces evaluate it as a light.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "effects/assets/built_in/mirror_hall.h"
#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr double kPi = 3.14159265358979;
constexpr std::uint32_t kSize = 96;
constexpr double kFieldOfView = 0.03;

const glm::dvec3 kBulb(0.6, 2.1, -2.0);
constexpr double kBulbRadius = 0.03, kBulbRadiance = 1e4;
// The bulb's outline has 24 corners.
const double kBulbArea = 12 * std::sin(2 * kPi / 24) * kBulbRadius * kBulbRadius;

// The light that local lights and reflections bring to a small picture that looks from `eye`
// towards `target`.
FloatImage look(const std::string& backend, Scene scene, const glm::dvec3& eye,
                const glm::dvec3& target) {
  scene.cameras.front().camera_to_world = look_at(eye, target);
  scene.cameras.front().vertical_fov = kFieldOfView;
  FrameSettings settings;
  settings.width = settings.height = kSize;
  settings.effects = choose_effects({"local", "contact", "reflections"});
  settings.denoise.method = DenoiseMethod::kNone;
  settings.volume.given = std::make_shared<IndirectVolume>();
  rtapi::DeviceDesc device;
  device.Backend = backend;
  const auto renderer = FrameRenderer::create(test::device_for(device), scene, settings).value();
  renderer->render().value();
  return renderer->read("radiance").value();
}

// Radiance of the first channel times solid angle, over the picture.
double energy(const FloatImage& image) {
  const double side = 2 * std::tan(0.5 * kFieldOfView) / kSize;
  double sum = 0;
  for (std::size_t i = 0; i < image.values.size(); i += image.channels) sum += image.values[i];
  return sum * side * side;
}

double schlick(double f0, double cosine) {
  return f0 + (1 - f0) * std::pow(1 - cosine, 5);
}

class Lamps : public test::OnBackends {};

// The image that a mirror shows of the bulb, in a plane through `point` with an axis as its normal.
void expect_image(const std::string& backend, double f0, const Scene& scene, const glm::dvec3& eye,
                  int axis, double plane) {
  glm::dvec3 image = kBulb;
  image[axis] = 2 * plane - image[axis];
  const glm::dvec3 direction = glm::normalize(image - eye);
  const double fresnel = schlick(f0, std::abs(direction[axis]));
  const double distance = glm::distance(eye, image);
  const double wanted = kBulbRadiance * fresnel * kBulbArea / (distance * distance);
  EXPECT_NEAR(energy(look(backend, scene, eye, image)) / wanted, 1, 0.02)
      << "axis " << axis << ", plane " << plane;
}

TEST_P(Lamps, EachImageOfTheBulbAppearsOnceInTheMirrorHall) {
  const Scene hall = make_mirror_hall();
  const glm::dvec3 eye = hall.cameras.front().position();
  expect_image(GetParam(), 0.95, hall, eye, 0, kMirrorHallHalfWidth);
  if (GetParam() == "vulkan") return;  // its pipelines take most of the time
  expect_image(GetParam(), 0.95, hall, eye, 0, -kMirrorHallHalfWidth);
  // The smooth end of the strip on the floor.
  expect_image(GetParam(), 0.9, hall, {-1.855, 0.541, 1.125}, 1, 0.021);
}

// A black floor of a smooth dielectric: what it mirrors is all that it shows.
TEST_P(Lamps, PolishedDielectricsShowTheBulbOnce) {
  Scene hall = make_mirror_hall();
  for (Material& material : hall.materials) {
    if (material.name != "floor") continue;
    material.constants.base_color = glm::vec4(0, 0, 0, 1);
    material.constants.roughness = 0;
  }
  expect_image(GetParam(), 0.04, hall, {1.7, 1.5, 0.5}, 1, 0);
}

// Rays off a rough surface pass through the bulb, whose light its main lighting has.
TEST_P(Lamps, RoughSurfacesReflectNoShapesOfLamps) {
  Scene hall = make_mirror_hall();
  hall.lights.clear();
  for (Material& material : hall.materials) material.constants.roughness = 0.1f;
  const glm::dvec3 image(2 * kMirrorHallHalfWidth - kBulb.x, kBulb.y, kBulb.z);
  const FloatImage seen = look(GetParam(), hall, hall.cameras.front().position(), image);
  for (const float value : seen.values) ASSERT_LT(value, 10.0f);
}

INSTANTIATE_TEST_SUITE_P(Backends, Lamps, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

}  // namespace
}  // namespace kaamos::effects
