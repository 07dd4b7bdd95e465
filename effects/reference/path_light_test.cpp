// SPDX-License-Identifier: MIT
// Each kind of light against quadrature, found by sampling lights, by sampling directions and by
// both; visibility against closed forms.
#include <gtest/gtest.h>

#include <functional>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/reference/host_bsdf_fixture.h"
#include "effects/reference/path_fixture.h"

namespace kaamos::effects {
namespace {

constexpr float kBase = 0.6f, kRoughness = 0.35f;
constexpr double kDegrees = 40;

// World directions of plane_scene to the axes of HostBsdf: y is up, the view leans towards +x.
glm::dvec3 to_local(const glm::dvec3& world) {
  return {world.x, -world.z, world.y};
}

class PathLights : public OnBackends {
 protected:
  // All three ways must agree with `expected`, the radiance of one colour.
  void expect_light(const Scene& scene, const std::string& layer, double expected) {
    for (const PathWays ways :
         {PathWays::kBoth, PathWays::kLightsOnly, PathWays::kDirectionsOnly}) {
      PathReferenceDesc desc;
      desc.width = desc.height = 16;
      desc.paths.bounces = 0;
      desc.paths.ways = ways;
      const auto reference = trace_reference(scene, desc, 512, GetParam());
      const double error = error_of(*reference, layer);
      EXPECT_NEAR(mean_of(*reference, layer), expected, 5 * error + 0.002 * expected)
          << "way " << static_cast<int>(ways) << ", error " << error;
      EXPECT_LT(error, 0.05 * expected) << "way " << static_cast<int>(ways);
    }
  }
  const HostBsdf bsdf_{kDegrees, kBase, 0, kRoughness};
};

Scene dark_plane() {
  return plane_scene(glm::vec3(kBase), 0, kRoughness, kDegrees, glm::vec3(0));
}

TEST_P(PathLights, SphereLamp) {
  Scene scene = dark_plane();
  Light lamp;
  lamp.position = {-0.8, 1.1, 0.3};
  lamp.radius = 0.4f;
  lamp.intensity = 3;
  lamp.range = 4;
  scene.lights.push_back(lamp);
  const double distance = glm::length(lamp.position);
  const double window = 1 - std::pow(distance / lamp.range, 4);
  const double radiance =
      lamp.intensity * window * window / (std::numbers::pi * lamp.radius * lamp.radius);
  const double expected =
      over_cone(to_local(lamp.position / distance), std::asin(lamp.radius / distance),
                [&](const glm::dvec3& light) { return radiance * bsdf_.times_cosine(light); });
  expect_light(scene, "lamps", expected);
}

// The lamp reaches below the horizon of the plane.
TEST_P(PathLights, SphereLampAtTheHorizon) {
  Scene scene = dark_plane();
  Light lamp;
  lamp.position = {-1.0, 0.1, 0.2};
  lamp.radius = 0.5f;
  lamp.intensity = 3;
  lamp.range = 1e4f;
  scene.lights.push_back(lamp);
  const double distance = glm::length(lamp.position);
  const double radiance = lamp.intensity / (std::numbers::pi * lamp.radius * lamp.radius);
  const double expected =
      over_cone(to_local(lamp.position / distance), std::asin(lamp.radius / distance),
                [&](const glm::dvec3& light) { return radiance * bsdf_.times_cosine(light); });
  expect_light(scene, "lamps", expected);
}

TEST_P(PathLights, ManyLampsOneOfThemASpot) {
  Scene scene = dark_plane();
  double expected = 0;
  for (int i = 0; i < 5; ++i) {
    Light lamp;
    lamp.position = {-0.9 + 0.5 * i, 1.0 + 0.3 * i, 0.4 - 0.3 * i};
    lamp.radius = 0.2f;
    lamp.intensity = 1.0f + static_cast<float>(i);
    lamp.range = 1e4f;
    const double distance = glm::length(lamp.position);
    const glm::dvec3 axis = lamp.position / distance;
    double cone = 1;
    if (i == 2) {
      lamp.type = LightType::kSpot;
      lamp.direction = glm::normalize(glm::vec3(-0.3f, -1.0f, 0.1f));
      lamp.inner_cone_angle = 0.2f;
      lamp.outer_cone_angle = 0.7f;
      const double inner = std::cos(0.2), outer = std::cos(0.7);
      const double cosine = -glm::dot(axis, glm::dvec3(lamp.direction));
      cone = std::pow(std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0), 2.0);
    }
    scene.lights.push_back(lamp);
    const double radiance = lamp.intensity * cone / (std::numbers::pi * lamp.radius * lamp.radius);
    expected += over_cone(to_local(axis), std::asin(lamp.radius / distance),
                          [&](const glm::dvec3& l) { return radiance * bsdf_.times_cosine(l); });
  }
  expect_light(scene, "lamps", expected);
  // The same where one lamp is chosen for each path.
  PathReferenceDesc desc;
  desc.width = desc.height = 16;
  desc.paths.bounces = 0;
  desc.paths.lamps_apart = 4;
  const auto reference = trace_reference(scene, desc, 1024, GetParam());
  EXPECT_NEAR(mean_of(*reference, "lamps"), expected,
              5 * error_of(*reference, "lamps") + 0.002 * expected);
}

TEST_P(PathLights, Sun) {
  Scene scene = dark_plane();
  scene.sun = Sun{glm::normalize(glm::vec3(-0.6f, 0.7f, 0.2f)), glm::vec3(2.0f), 0.15f};
  const double sine = std::sin(0.15);
  const double expected =
      over_cone(to_local(scene.sun->direction_to_sun), 0.15, [&](const glm::dvec3& light) {
        return 2.0 / (std::numbers::pi * sine * sine) * bsdf_.times_cosine(light);
      });
  expect_light(scene, "sun", expected);
}

// E2: the survey's sum over an area light has the light's normal in both cosines, and forgets the
// area. [effects/SOURCES.md]
TEST_P(PathLights, EmissiveTriangles) {
  Scene scene = dark_plane();
  const std::uint32_t dim = add_material(scene, glm::vec3(0), 0, 1, glm::vec3(1.5f));
  const std::uint32_t bright = add_material(scene, glm::vec3(0), 0, 1, glm::vec3(6.0f));
  const glm::dvec3 corner(-1.2, 0.9, -0.4);
  add_thing(scene, "panel", patch(corner, {0.8, 0.2, 0}, {0, 0.1, 0.7}, 2, 2), dim);
  const glm::dvec3 corner2(0.3, 1.4, 0.2);
  add_thing(scene, "small", patch(corner2, {0.2, 0, 0}, {0, 0.1, 0.15}, 1, 1), bright);
  const auto panel = [&](const glm::dvec3& at, const glm::dvec3& u, const glm::dvec3& v,
                         double glow) {
    constexpr int kSteps = 300;
    const glm::dvec3 normal = glm::cross(u, v);
    const glm::dvec3 unit = glm::normalize(normal);
    double sum = 0, survey = 0;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        const glm::dvec3 p = at + u * ((i + 0.5) / kSteps) + v * ((j + 0.5) / kSteps);
        const double d2 = glm::dot(p, p);
        const glm::dvec3 light = p / std::sqrt(d2);
        const double times_cosine = bsdf_.times_cosine(to_local(light));
        sum += glow * times_cosine * std::abs(glm::dot(normal, light)) / d2;
        survey += glow * times_cosine / light.y * std::pow(glm::dot(unit, light), 2) / d2;
      }
    }
    EXPECT_GT(std::abs(survey / sum - 1), 0.5) << "the survey's form is no rounding error away";
    return sum / (kSteps * kSteps);
  };
  const double expected = panel(corner, {0.8, 0.2, 0}, {0, 0.1, 0.7}, 1.5) +
                          panel(corner2, {0.2, 0, 0}, {0, 0.1, 0.15}, 6.0);
  expect_light(scene, "radiance", expected);
}

TEST_P(PathLights, Sky) {
  Scene scene = dark_plane();
  scene.sky.zenith = glm::vec3(0.3f);
  scene.sky.horizon = glm::vec3(2.0f);
  const double expected = over_hemisphere([&](const glm::dvec3& light) {
    return (2.0 + (0.3 - 2.0) * std::sqrt(light.z)) * bsdf_.times_cosine(light);
  });
  expect_light(scene, "radiance", expected);
}

// Closed forms of visibility.
TEST_P(PathLights, AmbientVisibilityUnderASphere) {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  const double x = 0.7;
  scene.cameras.front().camera_to_world = look_at({x, 0.3, 0.0}, {x, 0, 0}, {1, 0, 0});
  scene.cameras.front().vertical_fov = 1e-4;
  PathReferenceDesc desc;
  desc.width = desc.height = 8;
  desc.paths.bounces = 0;
  desc.paths.occlusion_radius = 1e30f;
  const auto reference = trace_reference(scene, desc, 2048, GetParam());
  EXPECT_NEAR(mean_of(*reference, "visibility", 0), 1 - sphere_occlusion(1.0, 1.5, x),
              5 * error_of(*reference, "visibility", 0));
}

TEST_P(PathLights, PenumbraOfTheSun) {
  const double height = 2, radius = 0.05, x = 0.03;
  Scene scene = make_penumbra_oracle(height, radius);
  scene.cameras.front().camera_to_world = look_at({x, 0.2, 0.0}, {x, 0, 0}, {1, 0, 0});
  scene.cameras.front().vertical_fov = 1e-4;
  PathReferenceDesc desc;
  desc.width = desc.height = 8;
  desc.paths.bounces = 0;
  const auto reference = trace_reference(scene, desc, 2048, GetParam());
  EXPECT_NEAR(mean_of(*reference, "visibility", 1), penumbra_visibility(height, radius, x),
              5 * error_of(*reference, "visibility", 1) + 1e-3);
}

// A lamp's picture is seen by the camera and by mirrors; other surfaces get the lamp's light once.
TEST_P(PathLights, PicturesOfLampsAreNoLights) {
  Scene scene = plane_scene(glm::vec3(kBase), 0, kRoughness, 0, glm::vec3(0));
  Light lamp;
  lamp.position = {0.5, 1, 0};
  lamp.radius = 0.1f;
  lamp.range = 1e4f;
  scene.lights.push_back(lamp);
  PathReferenceDesc desc;
  desc.width = desc.height = 8;
  const auto alone = trace_reference(scene, desc, 512, GetParam());
  Scene with_picture = scene;
  const std::uint32_t glow = add_material(with_picture, glm::vec3(0), 0, 1, glm::vec3(50.0f));
  add_thing(with_picture, "bulb", box({0.05, 0.05, 0.05}), glow, {0.5, 1, 0}).mask =
      kMaskEmissiveProxy;
  const auto both = trace_reference(with_picture, desc, 512, GetParam());
  EXPECT_GT(mean_of(*alone, "radiance"), 0.01);
  EXPECT_EQ(mean_of(*alone, "radiance"), mean_of(*both, "radiance"));
}

// The camera sees the base colour of an unlit surface times its vertex colour, and nothing
// mirrored.
TEST_P(PathLights, UnlitSurfacesShowTheirColor) {
  Scene scene = plane_scene(glm::vec3(0.5f), 0, 0.2f, kDegrees, glm::vec3(2));
  scene.materials[0].constants.flags |= kMaterialUnlit;
  scene.meshes[0].colors.assign(scene.meshes[0].vertices.size(), {32768, 65535, 65535, 65535});
  PathReferenceDesc desc;
  desc.width = desc.height = 4;
  const auto reference = trace_reference(scene, desc, 4, GetParam());
  EXPECT_NEAR(mean_of(*reference, "radiance", 0), 0.25, 1e-5);
  EXPECT_NEAR(mean_of(*reference, "radiance", 1), 0.5, 1e-5);
}

TEST_P(PathLights, VertexColorsMultiplyTheBaseColor) {
  const auto seen = [&](float base, const VertexColor& color) {
    Scene scene = plane_scene(glm::vec3(base), 0, 1, kDegrees);
    scene.meshes[0].colors.assign(scene.meshes[0].vertices.size(), color);
    PathReferenceDesc desc;
    desc.width = desc.height = 4;
    return mean_of(*trace_reference(scene, desc, 16, GetParam()), "radiance");
  };
  EXPECT_NEAR(seen(0.8f, {32768, 65535, 65535, 65535}), seen(0.4f, kWhite), 1e-4);
}

// Sampling lights and following rays agree that an emitter is nothing but a hole.
TEST_P(PathLights, HolesOfVertexColorsEmitNothing) {
  Scene scene = dark_plane();
  const std::uint32_t glow = add_material(scene, glm::vec3(0), 0, 1, glm::vec3(9));
  scene.materials[glow].constants.flags |= kMaterialMask | kMaterialAlphaTested;
  add_thing(scene, "holes", patch({-1, 2, 1}, {2, 0, 0}, {0, 0, -2}, 1, 1), glow);
  Mesh& mesh = scene.meshes.back();
  mesh.geometries[0].alpha_tested = true;
  mesh.colors.assign(mesh.vertices.size(), {65535, 65535, 65535, 16384});
  PathReferenceDesc desc;
  desc.width = desc.height = 4;
  EXPECT_EQ(mean_of(*trace_reference(scene, desc, 16, GetParam()), "radiance"), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Backends, PathLights, testing::Values("embree", "vulkan"), backend_of);

}  // namespace
}  // namespace kaamos::effects
