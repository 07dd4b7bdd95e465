// SPDX-License-Identifier: MIT
//
// Sweeps through the real passes: surfaces must not occlude themselves at any scale or distance;
// how fast an effect's error falls with the number of rays.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "effect_run.h"
#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/scene/shapes.h"
#include "size.h"

namespace kaamos::test {
namespace {

using namespace effects;

// A flat square of 2 x 16 x 16 triangles, tilted so that no coordinate is constant. The sky is open
// from every point on it, but every ray starts beside triangles in the same plane whose rounded
// corners stick out a little. The camera is `camera` sides away.
Scene tilted_square(double side, double camera, const glm::dvec3& place) {
  Scene scene = make_wall_oracle(1.0);  // supplies the material, sky and camera
  scene.meshes.resize(1);
  scene.instances.resize(1);
  scene.meshes[0] = Mesh{};
  scene.meshes[0].name = "square";
  add_shape(scene.meshes[0], patch({-0.5, 0, 0.5}, {1, 0, 0}, {0, 0, -1}, 16, 16), 0);
  for (Vertex& vertex : scene.meshes[0].vertices) vertex.position *= static_cast<float>(side);
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.6, glm::normalize(glm::dvec3(3, 1, 2)));
  scene.instances[0].transform = translate(place) * turn;
  const glm::dvec3 up(turn * glm::dvec4(0, 1, 0, 0));
  scene.cameras[0].camera_to_world = look_at(place + up * (camera * side), place);
  scene.cameras[0].vertical_fov = 2 * std::atan(0.2 / camera);
  return scene;
}

struct SelfOcclusion {
  std::uint32_t pixels = 0;  // that see the square
  double rays = 0;
  double blocked = 0;
};

SelfOcclusion self_occlusion(const Scene& scene, double radius) {
  EffectRun run;
  run.samples = by_size(16, 64, 1024);
  run.width = 48;
  run.height = 32;
  run.radius = static_cast<float>(radius);
  const EffectResult result = run_effect(scene, run);
  SelfOcclusion out;
  for (std::size_t i = 0; i < result.visibility.values.size(); ++i) {
    if (result.ids.values[i * 2] != 1) continue;
    ++out.pixels;
    out.rays += run.samples;
    out.blocked += (1 - static_cast<double>(result.visibility.values[i])) * run.samples;
  }
  return out;
}

void print(double value, const SelfOcclusion& row) {
  std::printf("%10.0e %8u %10.0f %9.0f\n", value, row.pixels, row.rays, row.blocked);
}

void print_head(const char* value) {
  std::printf("%10s %8s %10s %9s\n", value, "pixels", "rays", "blocked");
}

constexpr std::uint32_t kPixels = 48 * 32;

TEST(SelfOcclusionSweep, Scale) {
  std::printf("ambient occlusion of a flat square, radius = its side\n");
  print_head("side");
  for (int exponent = -9; exponent <= 12; exponent += 3) {
    const double side = std::pow(10.0, exponent);
    const SelfOcclusion row = self_occlusion(tilted_square(side, 2, glm::dvec3(0)), side);
    print(side, row);
    EXPECT_EQ(row.pixels, kPixels) << side;
    EXPECT_EQ(row.blocked, 0) << side;
  }
}

TEST(SelfOcclusionSweep, DistanceFromTheOrigin) {
  std::printf("ambient occlusion of a flat square of 1 m; camera and square move away together\n");
  print_head("distance");
  for (int exponent = -1; exponent <= 6; ++exponent) {
    const double distance = exponent < 0 ? 0 : std::pow(10.0, exponent);
    const glm::dvec3 place = glm::dvec3(0.6, -0.48, 0.64) * distance;
    const SelfOcclusion row = self_occlusion(tilted_square(1, 2, place), 1);
    print(distance, row);
    EXPECT_EQ(row.pixels, kPixels) << distance;
    EXPECT_EQ(row.blocked, 0) << distance;
  }
}

TEST(SelfOcclusionSweep, DistanceFromTheCamera) {
  std::printf("ambient occlusion of a flat square of 1 m, the camera far away from it\n");
  print_head("distance");
  for (int exponent = 0; exponent <= 6; ++exponent) {
    const double distance = std::pow(10.0, exponent);
    const SelfOcclusion row = self_occlusion(tilted_square(1, distance, glm::dvec3(0)), 1);
    print(distance, row);
    EXPECT_EQ(row.pixels, kPixels) << distance;
    EXPECT_EQ(row.blocked, 0) << distance;
  }
}

// Root mean square error over the pixels that see the plane, and over `scrambles` scrambles.
double error_at(EffectRun run, const Scene& scene, std::uint32_t scrambles,
                const std::function<double(double)>& truth) {
  const double origin = scene.cameras.front().position().x;
  double sum = 0;
  double count = 0;
  for (run.seed = 0; run.seed < scrambles; ++run.seed) {
    const EffectResult result = run_effect(scene, run);
    for (std::uint32_t i = 0; i < run.width * run.height; ++i) {
      if (result.ids.values[i * 2] != 1) continue;
      const double error =
          result.visibility.values[i] - truth(origin + result.position.values[i * 4]);
      sum += error * error;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

// The exponent by which the error falls: the slope of a least-squares line through the points.
double print_slope(EffectRun run, const Scene& scene, const std::function<double(double)>& truth) {
  const std::uint32_t most = by_size(64, 256, 4096);
  const std::uint32_t step = is_full_size() ? 2 : 4;
  const std::uint32_t scrambles = by_size(1, 2, 8);
  run.width = 48;
  run.height = 32;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  std::printf("%6s %10s\n", "rays", "RMSE");
  for (run.samples = 1; run.samples <= most; run.samples *= step) {
    const double error = error_at(run, scene, scrambles, truth);
    std::printf("%6u %10.2e\n", run.samples, error);
    const double x = std::log(run.samples), y = std::log(error);
    ++n, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  std::printf("slope %.2f\n", slope);
  return slope;
}

// Random samples give -0.5; Owen-scrambled Sobol points give about -0.75 over an edge.
TEST(SampleSweep, AmbientOcclusionFallsFasterThanWithRandomSamples) {
  EffectRun run;
  run.radius = 2.0f;
  const double slope = print_slope(run, make_wall_oracle(10.0),
                                   [](double x) { return 1 - wall_occlusion_bounded(2.0, x); });
  EXPECT_LT(slope, -0.65);
}

TEST(SampleSweep, PenumbraFallsFasterThanWithRandomSamples) {
  EffectRun run;
  run.effect = Effect::kSunShadow;
  Scene scene = make_penumbra_oracle(2.0, 0.05);
  scene.cameras.front().vertical_fov = 0.06;
  const double slope =
      print_slope(run, scene, [](double x) { return penumbra_visibility(2.0, 0.05, x); });
  EXPECT_LT(slope, -0.65);
}

}  // namespace
}  // namespace kaamos::test
