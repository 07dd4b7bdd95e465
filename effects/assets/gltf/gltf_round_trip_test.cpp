// SPDX-License-Identifier: MIT
// Scenes come back from their files bit for bit, and the files keep glTF's rules.
#include <gtest/gtest.h>
#include <tiny_gltf.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/gtc/constants.hpp>
#include <string>

#include "effects/assets/built_in/built_in.h"
#include "effects/assets/gltf/gltf_test_support.h"
#include "effects/assets/gltf/gltf_transform.h"
#include "effects/assets/gltf/gltf_write.h"
#include "effects/assets/scene/animation.h"

namespace kaamos::effects {
namespace {

std::vector<std::uint8_t> written(const Scene& scene) {
  auto bytes = encode_glb(scene);
  EXPECT_TRUE(bytes.ok()) << bytes.error().message;
  return bytes.ok() ? std::move(bytes.value()) : std::vector<std::uint8_t>();
}

bool same_bytes(const std::vector<Vertex>& a, const std::vector<Vertex>& b) {
  for (std::size_t i = 0; i < a.size() && a.size() == b.size(); ++i) {
    if (a[i].position != b[i].position || a[i].normal != b[i].normal ||
        a[i].tangent != b[i].tangent || a[i].uv != b[i].uv)
      return false;
  }
  return a.size() == b.size();
}

void expect_same_instances(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    const Instance &x = a.instances[i], &y = b.instances[i];
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(int{x.mask}, int{y.mask}) << x.name;
    EXPECT_EQ(x.transform, y.transform) << x.name;
    const Mesh &m = a.meshes[x.mesh], &n = b.meshes[y.mesh];
    ASSERT_EQ(m.geometries.size(), n.geometries.size()) << m.name;
    EXPECT_EQ(m.indices, n.indices) << m.name;
    EXPECT_TRUE(same_bytes(m.vertices, n.vertices)) << m.name;
    for (std::size_t g = 0; g < m.geometries.size(); ++g) {
      EXPECT_EQ(m.geometries[g].material, n.geometries[g].material) << m.name;
      EXPECT_EQ(m.geometries[g].alpha_tested, n.geometries[g].alpha_tested) << m.name;
    }
  }
}

void expect_same_materials(const Scene& a, const Scene& b) {
  ASSERT_LE(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    const MaterialConstants &x = a.materials[i].constants, &y = b.materials[i].constants;
    const std::string& name = a.materials[i].name;
    EXPECT_EQ(x.base_color, y.base_color) << name;
    EXPECT_EQ(x.emissive, y.emissive) << name;
    EXPECT_EQ(x.metallic, y.metallic) << name;
    EXPECT_EQ(x.roughness, y.roughness) << name;
    EXPECT_EQ(x.flags, y.flags) << name;
    if (x.flags & kMaterialMask) {
      EXPECT_EQ(x.alpha_cutoff, y.alpha_cutoff) << name;
    }
    for (std::uint32_t slot = 0; slot < kTextureSlotCount; ++slot) {
      ASSERT_EQ(x.image[slot] == kNoTexture, y.image[slot] == kNoTexture) << name;
      if (x.image[slot] == kNoTexture) continue;
      EXPECT_EQ(a.images[static_cast<std::size_t>(x.image[slot])].mips,
                b.images[static_cast<std::size_t>(y.image[slot])].mips)
          << name;
      EXPECT_EQ(a.samplers[x.sampler[slot]], b.samplers[y.sampler[slot]]) << name;
    }
  }
}

void expect_same_light(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.exposure, b.exposure);
  EXPECT_EQ(a.sky.zenith, b.sky.zenith);
  EXPECT_EQ(a.sky.horizon, b.sky.horizon);
  EXPECT_EQ(a.sky.ground, b.sky.ground);
  ASSERT_EQ(a.sun.has_value(), b.sun.has_value());
  if (a.sun) {
    EXPECT_EQ(a.sun->direction_to_sun, b.sun->direction_to_sun);
    EXPECT_EQ(a.sun->irradiance, b.sun->irradiance);
    EXPECT_EQ(a.sun->angular_radius, b.sun->angular_radius);
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    const Light &x = a.lights[i], &y = b.lights[i];
    EXPECT_EQ(x.type, y.type) << x.name;
    EXPECT_EQ(x.position, y.position) << x.name;
    EXPECT_EQ(x.radius, y.radius) << x.name;
    EXPECT_EQ(x.baked, y.baked) << x.name;
    EXPECT_EQ(x.range, y.range) << x.name;
    EXPECT_EQ(x.direction, y.direction) << x.name;
    const glm::vec3 p = x.color * x.intensity, q = y.color * y.intensity;
    EXPECT_LE(glm::distance(p, q), 1e-6f * glm::length(p)) << x.name;
    ASSERT_EQ(x.projection.has_value(), y.projection.has_value()) << x.name;
    if (!x.projection) continue;
    EXPECT_EQ(x.projection->up, y.projection->up) << x.name;
    EXPECT_EQ(a.images[x.projection->image].mips[0], b.images[y.projection->image].mips[0])
        << x.name;
    EXPECT_EQ(a.samplers[x.projection->sampler], b.samplers[y.projection->sampler]) << x.name;
  }
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (std::size_t i = 0; i < a.cameras.size(); ++i) {
    EXPECT_EQ(a.cameras[i].camera_to_world, b.cameras[i].camera_to_world);
    EXPECT_EQ(a.cameras[i].vertical_fov, b.cameras[i].vertical_fov);
    EXPECT_EQ(a.cameras[i].near_plane, b.cameras[i].near_plane);
  }
}

bool is_trs(const std::vector<double>& m) {
  double worst = 0.0;
  for (std::size_t c = 0; c < 3 && m.size() == 16; ++c) {
    const glm::dvec3 a(m[4 * c], m[4 * c + 1], m[4 * c + 2]);
    const std::size_t d = 4 * ((c + 1) % 3);
    const glm::dvec3 b(m[d], m[d + 1], m[d + 2]);
    worst = std::max(worst, std::abs(glm::dot(a, b)) / (glm::length(a) * glm::length(b)));
  }
  return worst < 2e-7;
}

// Expects the rules that a writer of scenes can break and whose breach the Khronos validator
// reports as an error.
void expect_rules(const std::vector<std::uint8_t>& bytes) {
  tinygltf::Model model;
  tinygltf::TinyGLTF loader;
  std::string error, warning;
  loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int,
                           const unsigned char*, int, void*) { return true; },
                        nullptr);
  ASSERT_TRUE(loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(),
                                          static_cast<unsigned>(bytes.size())))
      << error;
  for (const tinygltf::Camera& camera : model.cameras) {
    EXPECT_GE(camera.perspective.znear, 0.0) << camera.name;
    EXPECT_GT(camera.perspective.zfar, camera.perspective.znear) << camera.name;
  }
  for (const tinygltf::Light& light : model.lights) {
    for (const double part : light.color) EXPECT_TRUE(part >= 0.0 && part <= 1.0) << light.name;
    EXPECT_TRUE(std::isfinite(light.intensity) && light.intensity >= 0.0) << light.name;
    if (light.type != "spot") continue;
    EXPECT_LT(light.spot.innerConeAngle, light.spot.outerConeAngle) << light.name;
    EXPECT_LE(light.spot.outerConeAngle, 0.5 * glm::pi<double>()) << light.name;
  }
  for (const tinygltf::Material& material : model.materials)
    for (const double part : material.emissiveFactor)
      EXPECT_TRUE(part >= 0.0 && part <= 1.0) << material.name;
  for (const tinygltf::Node& node : model.nodes) EXPECT_TRUE(is_trs(node.matrix)) << node.name;
  for (const tinygltf::Mesh& mesh : model.meshes) EXPECT_FALSE(mesh.primitives.empty());
  for (const tinygltf::Accessor& accessor : model.accessors) EXPECT_GT(accessor.count, 0u);
}

TEST(GltfRoundTrip, EveryBuiltInSceneComesBackBitForBit) {
  for (const BuiltInScene& entry : built_in_scenes()) {
    SCOPED_TRACE(entry.name);
    const Scene scene = posed_scene(entry.make(), 0.0);
    const auto loaded = load(written(scene));
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    EXPECT_TRUE(loaded.value().complete);
    EXPECT_TRUE(loaded.value().warnings.empty());
    expect_same_instances(scene, loaded.value().scene);
    expect_same_materials(scene, loaded.value().scene);
    expect_same_light(scene, loaded.value().scene);
  }
}

// The mesh of the runner is written as the skinning deforms it at time 0.
TEST(GltfRoundTrip, WhatMovesIsWrittenAsItIsAtTimeZero) {
  const Scene runner = find_built_in_scene("runner")->make();
  const auto loaded = load(written(runner));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  expect_same_instances(posed_scene(runner, 0.0), loaded.value().scene);
  EXPECT_TRUE(loaded.value().scene.skins.empty());
}

TEST(GltfRoundTrip, EveryBuiltInSceneKeepsTheRules) {
  for (const BuiltInScene& entry : built_in_scenes()) {
    SCOPED_TRACE(entry.name);
    expect_rules(written(entry.make()));
  }
}

Scene awkward_scene() {
  Scene scene = load(QuadFile{}.bytes()).value().scene;
  scene.sun.reset();
  scene.exposure = 0.3f;
  scene.sky = {.zenith = glm::vec3(0.1f, 0.2f, 30.0f), .ground = glm::vec3(0.7f)};
  scene.instances[0].mask = kMaskOpaque | kMaskEmissiveProxy;
  scene.instances[0].transform =
      glm::dmat4(1, 0.2, 0, 0, 0.7, 2, -0.4, 0, 0.1, 0.3, -1.5, 0, 4, 5, 6, 1);
  Light spot;
  spot.name = "spot";
  spot.type = LightType::kSpot;
  spot.color = glm::vec3(4.0f, 2.0f, 0.0f);
  spot.inner_cone_angle = spot.outer_cone_angle = 1.57079637f;
  spot.direction = glm::normalize(glm::vec3(1, -2, 0.3f));
  spot.position = {1e3, 2, 3};
  spot.radius = 0.0f;
  spot.baked = false;
  scene.lights.push_back(spot);
  Light moon;
  moon.name = "moon";
  moon.type = LightType::kDirectional;
  moon.range = 3.0f;
  scene.lights.push_back(moon);
  return scene;
}

// Shear, colours above 1, angles that glTF does not allow; and no directional light becomes the sun
// that the scene does not have.
TEST(GltfRoundTrip, AnAwkwardSceneKeepsTheRulesAndComesBack) {
  const Scene scene = awkward_scene();
  const std::vector<std::uint8_t> bytes = written(scene);
  expect_rules(bytes);
  const auto loaded = load(bytes);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const Scene& back = loaded.value().scene;
  EXPECT_FALSE(back.sun.has_value());
  EXPECT_EQ(back.sky.zenith, scene.sky.zenith);
  EXPECT_EQ(back.exposure, 0.3f);
  ASSERT_EQ(back.instances.size(), 1u);
  EXPECT_EQ(int{back.instances[0].mask}, int{scene.instances[0].mask});
  const glm::dmat4 &x = scene.instances[0].transform, &y = back.instances[0].transform;
  for (int c = 0; c < 4; ++c) EXPECT_LT(glm::distance(x[c], y[c]), 1e-13) << c;
  ASSERT_EQ(back.lights.size(), 2u);
  EXPECT_EQ(back.lights[0].radius, 0.0f);
  EXPECT_FALSE(back.lights[0].baked);
  EXPECT_EQ(back.lights[0].direction, scene.lights[0].direction);
  const glm::vec3 intensity = back.lights[0].color * back.lights[0].intensity;
  EXPECT_LT(glm::distance(intensity, scene.lights[0].color), 1e-5f);
}

TEST(GltfRoundTrip, ShearIsSplitIntoRotationsAndScales) {
  const glm::dmat4 sheared(1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, -3, 0, 7, 8, 9, 1);
  const auto parts = without_shear(sheared);
  ASSERT_EQ(parts.size(), 2u);
  const glm::dmat4 product = parts[0] * parts[1];
  for (int c = 0; c < 4; ++c) EXPECT_LT(glm::distance(product[c], sheared[c]), 1e-14) << c;
  EXPECT_NEAR(glm::determinant(parts[1]), 1.0, 1e-14);
  EXPECT_EQ(without_shear(glm::dmat4(2.0)).size(), 1u);
}

/// Runs on a file, exits with 0 if it has no errors and prints what is wrong with it; empty where
/// the validator is not installed. Khronos ships it as a program and as a module of Node.js, for
/// which NODE_PATH names the folder.
std::string validator_command() {
  const auto runs = [](const char* command) { return std::system(command) == 0; };
  if (runs("command -v gltf_validator > /dev/null 2>&1")) return "gltf_validator --stdout ";
  if (!runs("node -e \"require('gltf-validator')\" > /dev/null 2>&1")) return "";
  return "node -e \"require('gltf-validator').validateBytes(new Uint8Array("
         "require('fs').readFileSync(process.argv[1]))).then(report => {"
         "for (const issue of report.issues.messages.filter(m => m.severity == 0))"
         "console.log(issue.pointer, issue.message);"
         "process.exit(report.issues.numErrors > 0 ? 1 : 0); })\" ";
}

TEST(GltfRoundTrip, TheKhronosValidatorAcceptsWhatIsWritten) {
  const std::string validator = validator_command();
  if (validator.empty())
    GTEST_SKIP() << "the Khronos glTF validator is not installed: neither gltf_validator on the "
                    "PATH nor Node.js with gltf-validator in NODE_PATH";
  const std::string path = (std::filesystem::temp_directory_path() /
                            ("kaamos-validated-" + std::to_string(::getpid()) + ".glb"))
                               .string();
  std::vector<Scene> scenes = {awkward_scene()};
  for (const BuiltInScene& entry : built_in_scenes()) scenes.push_back(entry.make());
  for (const Scene& scene : scenes) {
    ASSERT_TRUE(write_glb(path, scene).ok());
    EXPECT_EQ(std::system((validator + path).c_str()), 0) << scene.name;
  }
  std::filesystem::remove(path);
}

TEST(GltfExtras, UnusableValuesAreLeftOutWithAWarning) {
  QuadFile file;
  file.nodes = R"([{"mesh":0,"extras":{"kaamos":{"mask":1000}}}])";
  file.more = R"(,"scene":0,"scenes":[{"nodes":[0],"extras":{"kaamos":{"exposure":"high",)"
              R"("sky":{"zenith":[1,2],"horizon":[0.5,0.5,0.5]}}}}])";
  const auto loaded = load(file.bytes());
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  ASSERT_EQ(loaded.value().warnings.size(), 3u);
  EXPECT_NE(loaded.value().warnings[0].find("mask is not a number from 0 to 255"),
            std::string::npos)
      << loaded.value().warnings[0];
  EXPECT_EQ(int{loaded.value().scene.instances[0].mask}, int{kMaskOpaque});
  EXPECT_EQ(loaded.value().scene.exposure, 1.0f);
  EXPECT_EQ(loaded.value().scene.sky.horizon, glm::vec3(0.5f));
  EXPECT_FALSE(loaded.value().complete) << "it has no camera";
}

TEST(GltfExtras, AMaterialNamesAModelOfItsOwn) {
  const auto with_model = [](const std::string& model) {
    QuadFile file;
    file.nodes = R"([{"mesh":0}])";
    file.more = R"(,"materials":[{"extras":{"kaamos":{"model":)" + model + "}}}]";
    return load(file.bytes());
  };
  const auto hair = with_model(R"("hair")");
  ASSERT_TRUE(hair.ok()) << hair.error().message;
  EXPECT_TRUE(hair.value().warnings.empty());
  EXPECT_EQ(hair.value().scene.materials.front().constants.flags, kMaterialHair);
  for (const char* unknown : {R"("fur")", "3"}) {
    const auto loaded = with_model(unknown);
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    ASSERT_EQ(loaded.value().warnings.size(), 1u);
    EXPECT_NE(loaded.value().warnings[0].find("model is not \"skin\", \"eye\" or \"hair\""),
              std::string::npos)
        << loaded.value().warnings[0];
    EXPECT_EQ(loaded.value().scene.materials.front().constants.flags, 0u);
  }
}

TEST(GltfExtras, ASlideNamesATextureOfTheFile) {
  const auto with_slide = [](const std::string& projection) {
    QuadFile file;
    file.nodes = R"([{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":0}},)"
                 R"("extras":{"kaamos":{"lamp":{"projection":)" +
                 projection + "}}}}]";
    file.more = R"(,"scene":0,"scenes":[{"nodes":[0,1]}],"extensions":{"KHR_lights_punctual":)"
                R"({"lights":[{"type":"spot","spot":{}}]}})";
    return load(file.bytes());
  };
  const auto missing = with_slide(R"({"texture":7})");
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().message.find("names texture 7 of"), std::string::npos)
      << missing.error().message;
  const auto half = with_slide(R"({"texture":0.5})");
  ASSERT_TRUE(half.ok()) << half.error().message;
  ASSERT_EQ(half.value().warnings.size(), 1u);
  EXPECT_NE(half.value().warnings[0].find("texture is not whole"), std::string::npos)
      << half.value().warnings[0];
  EXPECT_FALSE(half.value().scene.lights.at(0).projection.has_value());
}

}  // namespace
}  // namespace kaamos::effects
