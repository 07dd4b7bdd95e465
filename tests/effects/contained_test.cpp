// SPDX-License-Identifier: MIT
//
// Broken inputs: a NaN stays where it came from and does not outlive its frame.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "comparing.h"
#include "room.h"

namespace kaamos::test {
namespace {

using namespace effects;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

RigOptions all_effects() {
  RigOptions options;
  options.width = 32;
  options.height = 18;
  options.samples = 2;
  return options;
}

Scene with_metal(const std::function<void(MaterialConstants&)>& change) {
  Scene scene = make_room();
  change(scene.materials[kRoomMetal].constants);
  return scene;
}

// A broken material behaves as if its broken values were 0, for every effect alike: in its own
// pixels, in mirrors and in the volume of indirect light.
TEST(Contained, BrokenMaterialsAreBlackOnes) {
  struct {
    const char* what;
    void (*set)(MaterialConstants&, float);
  } const fields[] = {
      {"base color", [](MaterialConstants& m, float v) { m.base_color = glm::vec4(v, v, v, 1); }},
      {"emissive", [](MaterialConstants& m, float v) { m.emissive = glm::vec3(v); }},
      {"metallic", [](MaterialConstants& m, float v) { m.metallic = v; }},
      {"roughness", [](MaterialConstants& m, float v) { m.roughness = v; }},
  };
  for (const auto& field : fields) {
    const Pictures zero =
        render(with_metal([&](MaterialConstants& m) { field.set(m, 0); }), all_effects());
    EXPECT_EQ(not_finite(zero), "") << field.what;
    for (const float broken : {kNan, -kInfinity, -1.0f}) {
      const Pictures now =
          render(with_metal([&](MaterialConstants& m) { field.set(m, broken); }), all_effects());
      EXPECT_EQ(differing(now, zero, {}), "") << field.what << " " << broken;
    }
    for (const float large : {kInfinity, 1e38f, 65504.0f, 1e-40f}) {
      const Pictures now =
          render(with_metal([&](MaterialConstants& m) { field.set(m, large); }), all_effects());
      EXPECT_EQ(not_finite(now), "") << field.what << " " << large;
    }
  }
}

// The triangle's own normal is used instead.
TEST(Contained, BrokenNormalsAndTangents) {
  for (const float broken : {kNan, kInfinity, -kInfinity, 0.0f, 1e38f, 1e-40f}) {
    Scene scene = make_room();
    for (Mesh& mesh : scene.meshes) {
      if (mesh.name != "ball" && mesh.name != "floor") continue;
      for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
        mesh.vertices[i].normal = glm::vec3(broken);
        mesh.vertices[i].tangent = glm::vec4(broken);
      }
    }
    EXPECT_EQ(not_finite(render(scene, all_effects())), "") << broken;
  }
}

TEST(Contained, BrokenTextureCoordinates) {
  for (const float broken : {kNan, kInfinity, -kInfinity, 1e38f, -1e38f}) {
    Scene scene = make_room();
    for (Mesh& mesh : scene.meshes) {
      if (mesh.name == "card") mesh.vertices[0].uv = glm::vec2(broken);
    }
    EXPECT_EQ(not_finite(render(scene, all_effects())), "") << broken;
  }
}

struct Breakage {
  const char* what;
  void (*apply)(Scene&);
};

const Breakage kBroken[] = {
    {"light colour", [](Scene& s) { s.lights[0].color = glm::vec3(kNan); }},
    {"one channel of a light", [](Scene& s) { s.lights[1].color.y = kInfinity; }},
    {"light intensity", [](Scene& s) { s.lights[0].intensity = -kInfinity; }},
    {"light position", [](Scene& s) { s.lights[0].position.x = kNan; }},
    {"light infinitely far", [](Scene& s) { s.lights[1].position = glm::dvec3(kInfinity); }},
    {"light radius", [](Scene& s) { s.lights[0].radius = kNan; }},
    {"light direction", [](Scene& s) { s.lights[1].direction = glm::vec3(kNan); }},
    {"cone", [](Scene& s) { s.lights[1].outer_cone_angle = kNan; }},
    {"sun irradiance", [](Scene& s) { s.sun->irradiance = glm::vec3(1, kNan, 1); }},
    {"sun direction", [](Scene& s) { s.sun->direction_to_sun = glm::vec3(kNan); }},
    {"no sun direction", [](Scene& s) { s.sun->direction_to_sun = glm::vec3(0); }},
    {"sky", [](Scene& s) { s.sky.zenith = glm::vec3(kInfinity, 0, kNan); }},
};

// A NaN light does not shine; the rest of the room is unchanged.
TEST(Contained, BrokenLightsAreDarkOnes) {
  for (const Breakage& broken : kBroken) {
    Scene scene = make_room();
    broken.apply(scene);
    EXPECT_EQ(not_finite(render(scene, all_effects())), "") << broken.what;
  }
  Scene broken = make_room(), dark = make_room();
  broken.lights[0].color = glm::vec3(kNan);
  dark.lights[0].intensity = 0;
  EXPECT_EQ(differing(render(broken, all_effects()), render(dark, all_effects()), {}), "");
}

// A frame with broken light leaves nothing behind in any history. Enormous light is not broken, but
// its square overflows a float.
TEST(Contained, BrokenFramesLeaveNothingBehind) {
  const Breakage enormous = {"1e30 cd", [](Scene& s) {
                               for (Light& light : s.lights) light.intensity = 1e30f;
                             }};
  for (const DenoiseMethod method : {DenoiseMethod::kSvgf, DenoiseMethod::kTemporal}) {
    RigOptions options = all_effects();
    options.denoise = method;
    std::vector<Scene> frames = {make_room()};
    for (const Breakage& broken : {kBroken[0], kBroken[8], enormous}) {
      frames.push_back(make_room());
      broken.apply(frames.back());
      frames.push_back(make_room());
    }
    const std::vector<Pictures> seen = render_frames(frames, options);
    for (std::size_t i = 0; i < seen.size(); i += 2) {
      EXPECT_EQ(not_finite(seen[i]), "") << "frame " << i;
    }
  }
}

}  // namespace
}  // namespace kaamos::test
