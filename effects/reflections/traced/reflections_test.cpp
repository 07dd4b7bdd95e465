// SPDX-License-Identifier: MIT
// Reflections against known answers.
#include "effects/reflections/traced/reflections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/common/specular_albedo.h"
#include "effects/assets/scene/checkers_fixture.h"
#include "effects/northlight/frame_renderer.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kSize = 16;

// A lone plane of perfectly reflecting metal under a sky of 1. The camera looks at it at `angle`
// from its normal, through a field so narrow that the angle holds for every pixel.
Scene furnace(double angle, float alpha) {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  scene.instances.resize(1);
  scene.meshes.resize(1);
  for (Material& material : scene.materials) {
    material.constants.base_color = glm::vec4(1);
    material.constants.metallic = 1;
    material.constants.roughness = std::sqrt(alpha);
  }
  scene.sky.zenith = scene.sky.horizon = scene.sky.ground = glm::vec3(1.0f);
  scene.sun.reset();
  scene.lights.clear();
  Camera& camera = scene.cameras.front();
  camera.camera_to_world =
      look_at(glm::dvec3(5 * std::sin(angle), 5 * std::cos(angle), 0), glm::dvec3(0));
  camera.vertical_fov = 0.002;
  return scene;
}

struct Reflected {
  FloatImage sum;  // over the samples
  FloatImage position, ids;
};

Reflected reflect(const Scene& scene, std::uint32_t samples, const ReflectionConstants& constants) {
  FrameSettings settings;
  settings.width = kSize;
  settings.height = kSize;
  settings.effects = choose_effects({"reflections"});
  settings.effects.at("reflections").set_constants(constants);
  settings.volume.given = std::make_shared<IndirectVolume>();
  const auto renderer =
      FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  renderer->run("reflections", samples).value();
  return {renderer->read(renderer->effects().sum("reflection")).value(),
          renderer->read("position").value(), renderer->read("ids").value()};
}

// Single scattering loses the light that microfacets reflect onto others. The exact loss is known
// from quadrature.
TEST(Reflections, WhiteFurnace) {
  struct {
    float alpha;
    double degrees, expected;
  } const rows[] = {{0.1f, 80, 0.8955},
                    {0.5f, 0, 0.6878},
                    {0.5f, 30, 0.6831},
                    {1.0f, 85, 0.7801},
                    {1.0f, 0, 0.3069}};
  for (const auto& row : rows) {
    const double angle = row.degrees * 3.14159265358979 / 180;
    const std::uint32_t samples = 1024;
    const Reflected result = reflect(furnace(angle, row.alpha), samples, {});
    double sum = 0;
    for (std::size_t i = 0; i < result.sum.values.size(); i += 4) sum += result.sum.values[i];
    const double albedo =
        specular_albedo(glm::vec3(1), std::sqrt(row.alpha), static_cast<float>(std::cos(angle))).x;
    const double mean = sum / (kSize * kSize * samples) * albedo;
    EXPECT_NEAR(mean, row.expected, 0.005 * row.expected + 0.001)
        << "alpha " << row.alpha << " at " << row.degrees << " degrees";
  }
}

// The whole material under uniform light: what the frame is put together from, with `metallic` and
// the same base colour for all.
double furnace_radiance(double angle, float roughness, float metallic, float base_color) {
  Scene scene = furnace(angle, roughness * roughness);
  for (Material& material : scene.materials) {
    material.constants.metallic = metallic;
    material.constants.base_color = glm::vec4(glm::vec3(base_color), 1);
  }
  FrameSettings settings;
  settings.width = settings.height = kSize;
  settings.effects = choose_effects({"gi", "reflections"});
  settings.effects.at("reflections").samples = 48;
  settings.denoise.method = DenoiseMethod::kNone;
  settings.volume.given = std::make_shared<IndirectVolume>();
  const auto renderer =
      FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  renderer->render().value();
  const FloatImage seen = renderer->read("radiance").value();
  double sum = 0;
  for (std::size_t i = 0; i < seen.values.size(); i += seen.channels) sum += seen.values[i];
  return sum / (kSize * kSize);
}

// The diffuse lobe has what the specular lobe leaves: a white dielectric is as bright as the light
// around it, and nothing is brighter.
TEST(Reflections, EnergyIsNeverAboveOne) {
  for (const double degrees : {0.0, 45.0, 70.0, 80.0, 87.0}) {
    const double angle = degrees * 3.14159265358979 / 180;
    for (const float roughness : {0.0f, 0.3f, 0.6f, 1.0f}) {
      const std::string where =
          "roughness " + std::to_string(roughness) + " at " + std::to_string(degrees) + " degrees";
      EXPECT_NEAR(furnace_radiance(angle, roughness, 0, 1), 1, 0.005) << where;
      EXPECT_LE(furnace_radiance(angle, roughness, 1, 1), 1.005) << where;
      EXPECT_LE(furnace_radiance(angle, roughness, 0.5f, 0.6f), 0.95) << where;
    }
  }
}

// A mirror under a sphere: the length of each ray is that of the exact reflection.
TEST(Reflections, MirrorsHitWhereTheyMust) {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  for (Material& material : scene.materials) material.constants.roughness = 0;
  const Reflected result = reflect(scene, 1, {});
  const glm::dvec3 eye = scene.cameras.front().position();
  int hits = 0;
  for (std::uint32_t y = 0; y < kSize; ++y) {
    for (std::uint32_t x = 0; x < kSize; ++x) {
      if (result.ids.at(x, y, 0) != 1.0f) continue;  // the plane
      const glm::dvec3 from_eye(result.position.at(x, y, 0), result.position.at(x, y, 1),
                                result.position.at(x, y, 2));
      const glm::dvec3 p = eye + from_eye;
      glm::dvec3 direction = glm::normalize(from_eye);
      direction.y = -direction.y;
      const glm::dvec3 to_center = glm::dvec3(0, 1.5, 0) - p;
      const double along = glm::dot(to_center, direction);
      const double aside = glm::length(to_center - along * direction);
      if (std::abs(aside - 1) < 0.02) continue;  // the sphere consists of triangles
      const double expected = aside < 1 ? along - std::sqrt(1 - aside * aside) : 200;
      ASSERT_NEAR(result.sum.at(x, y, 3), expected, aside < 1 ? 0.05 : 45) << x << "," << y;
      hits += aside < 1;
    }
  }
  EXPECT_GT(hits, 3);
}

// A white mirror shows a white metal ball under a sky of 1. The ball reflects all it receives, so
// it is as bright as the sky beside it. The volume stores nothing here and returns the sky.
TEST(Reflections, MirrorsInMirrorsAreNotBlack) {
  Scene scene = furnace(0, 0);
  const Scene ball = make_sphere_oracle(1.0, 1.5);
  scene.meshes = ball.meshes;
  scene.instances = ball.instances;
  scene.cameras = ball.cameras;
  const Reflected result = reflect(scene, 1, {});
  int hits = 0;
  for (std::uint32_t y = 0; y < kSize; ++y) {
    for (std::uint32_t x = 0; x < kSize; ++x) {
      if (result.ids.at(x, y, 0) != 1.0f) continue;  // the plane
      for (std::uint32_t c = 0; c < 3; ++c) EXPECT_NEAR(result.sum.at(x, y, c), 1, 0.05);
      hits += result.sum.at(x, y, 3) < 100;  // rays that hit the ball rather than end
    }
  }
  EXPECT_GT(hits, 3);
}

// A ball with bright checks that are smaller than a pixel at that distance, seen in a mirror beside
// it. They must average to one grey, because the pixel's cone starts at the camera, not at the
// mirror.
TEST(Reflections, MirrorsShowTexturesAsFineAsTheCameraSeesThem) {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  scene.sky.zenith = scene.sky.horizon = scene.sky.ground = glm::vec3(0.0f);
  scene.sun.reset();
  scene.images.push_back(make_checkers());
  Material ball = scene.materials[0];
  ball.constants.base_color = glm::vec4(0, 0, 0, 1);
  ball.constants.emissive = glm::vec3(1);
  ball.constants.image[kEmissiveTexture] = 0;
  scene.materials[0].constants.base_color = glm::vec4(1);
  scene.materials[0].constants.metallic = 1;
  scene.materials[0].constants.roughness = 0;
  scene.materials.push_back(ball);
  Mesh& mesh = scene.meshes[scene.instances[1].mesh];
  for (Geometry& geometry : mesh.geometries) geometry.material = 1;
  for (Vertex& vertex : mesh.vertices) {  // 8 mm per texel
    vertex.uv = glm::vec2(vertex.position.x, vertex.position.z) * 2.0f;
  }
  Camera& camera = scene.cameras.front();
  camera.camera_to_world = look_at(glm::dvec3(41.5, 40, 0), glm::dvec3(1.5, 0, 0));
  camera.vertical_fov = 0.01;  // 36 mm per pixel at the mirror; at the ball 1 mm more
  const Reflected result = reflect(scene, 1, {});
  for (std::uint32_t i = 0; i < kSize; ++i) {
    ASSERT_LT(result.sum.at(i, i, 3), 5) << "the ball must be hit";
    EXPECT_NEAR(result.sum.at(i, i, 0), 0.5, 0.1) << i;
  }
}

// Clamping removes energy and does nothing else; the picture shows how much. White is 1.
TEST(Reflections, TheFireflyLimitOnlyDarkens) {
  Scene scene = furnace(0.5, 0.5f);
  scene.sky.zenith = glm::vec3(8.0f);
  ReflectionConstants kept, clamped;
  kept.fireflies = clamped.fireflies = Fireflies::kKeep;
  clamped.firefly_limit = 2;
  const Reflected free = reflect(scene, 16, kept), limited = reflect(scene, 16, clamped);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < free.sum.values.size(); i += 4) {
    ASSERT_LE(limited.sum.values[i], free.sum.values[i] * 1.0001f);
    before += free.sum.values[i];
    after += limited.sum.values[i];
  }
  EXPECT_LT(after / before, 0.7);
  EXPECT_GT(after, 0);
}

// A rough metal floor under a bright ball in the dark: most samples are black, some are far above
// white. Each run takes one sample per pixel, as a frame does.
struct Fires {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  std::unique_ptr<FrameRenderer> renderer;

  Fires() {
    scene.sky.zenith = scene.sky.horizon = scene.sky.ground = glm::vec3(0.0f);
    scene.sun.reset();
    Material ball = scene.materials[0];
    ball.constants.emissive = glm::vec3(100);
    scene.materials[0].constants.base_color = glm::vec4(1);
    scene.materials[0].constants.metallic = 1;
    scene.materials[0].constants.roughness = 0.7f;
    scene.materials.push_back(ball);
    scene.meshes[scene.instances[1].mesh].geometries[0].material = 1;
    Camera& camera = scene.cameras.front();
    camera.camera_to_world = look_at(glm::dvec3(6, 3, 0), glm::dvec3(-1.5, 0, 0));
    camera.vertical_fov = 0.1;
    FrameSettings settings;
    settings.width = settings.height = kSize;
    settings.effects = choose_effects({"reflections"});
    settings.volume.given = std::make_shared<IndirectVolume>();
    renderer = FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  }

  double energy(const ReflectionConstants& constants, std::uint32_t runs, std::uint32_t samples) {
    EffectSettings settings;
    settings.set_constants(constants);
    settings.samples = samples;
    double sum = 0;
    for (std::uint32_t run = 0; run < runs; ++run) {
      renderer->run("reflections", settings, run * samples).value();
      const FloatImage image = renderer->read(renderer->effects().sum("reflection")).value();
      for (std::size_t i = 0; i < image.values.size(); i += 4) sum += image.values[i];
    }
    return sum / (static_cast<double>(runs) * samples * kSize * kSize);
  }
};

// The default treatment of fireflies keeps the energy; the talk's average and its clamp do not.
TEST(Reflections, OnlyAPilotKeepsTheEnergyOfFireflies) {
  Fires fires;
  ReflectionConstants constants;
  constants.fireflies = Fireflies::kKeep;
  const double wanted = fires.energy(constants, 4, 1024);
  ASSERT_GT(wanted, 2) << "brighter than the limit";
  EXPECT_NEAR(fires.energy(ReflectionConstants{}, 400, 1) / wanted, 1, 0.02);
  ReflectionConstants averaged;
  averaged.fireflies = Fireflies::kAverage;
  const double kept = fires.energy(averaged, 100, 1) / wanted;
  EXPECT_LT(kept, 0.8);
  constants.firefly_limit = 10;
  EXPECT_LT(fires.energy(constants, 4, 256) / wanted, 0.5);
}

}  // namespace
}  // namespace kaamos::effects
