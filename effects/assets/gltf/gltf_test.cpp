// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "effects/assets/common/sampling.h"
#include "effects/assets/gltf/gltf_test_support.h"

namespace kaamos::effects {
namespace {

TEST(GltfLoad, QuadWithoutAnythingElse) {
  const auto loaded = load(QuadFile{}.bytes());
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const Scene& scene = loaded.value().scene;
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].name, "quad");
  EXPECT_EQ(scene.meshes[0].triangle_count(), 2u);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.materials.size(), 1u) << "the default material";
  EXPECT_EQ(scene.cameras.size(), 1u) << "one that frames the scene";
  EXPECT_TRUE(scene.sun.has_value());
  EXPECT_GT(scene.sky.zenith.z, 0.0f);
  for (const Vertex& vertex : scene.meshes[0].vertices)
    EXPECT_EQ(vertex.normal, glm::vec3(0, 0, 1)) << "flat normals where the file has none";
  EXPECT_TRUE(loaded.value().warnings.empty());
}

TEST(GltfLoad, NonIndexedStripsAndFans) {
  const auto triangles = [](const std::string& primitive) {
    QuadFile file;
    file.primitive = primitive;
    const auto loaded = load(file.bytes());
    EXPECT_TRUE(loaded.ok()) << loaded.error().message;
    return loaded.ok() ? loaded.value().scene : Scene{};
  };
  EXPECT_EQ(unique_triangle_count(triangles(R"({"attributes":{"POSITION":0}})")), 1u)
      << "4 vertices are one triangle and a rest";
  for (const char* mode : {"5", "6"}) {
    const Scene scene =
        triangles(std::string(R"({"attributes":{"POSITION":0},"mode":)") + mode + "}");
    ASSERT_EQ(unique_triangle_count(scene), 2u);
    // The strip 0 1 2 3 of the quad winds the same way throughout; the fan's second triangle folds
    // over.
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.corner(mesh.geometries[0], 0, 0).normal.z, 1.0f);
    EXPECT_EQ(mesh.corner(mesh.geometries[0], 1, 0).normal.z, mode[0] == '5' ? 1.0f : -1.0f);
  }
}

TEST(GltfLoad, PointsAreLeftOutWithAWarning) {
  QuadFile file;
  file.primitive =
      R"({"attributes":{"POSITION":0},"mode":0},{"attributes":{"POSITION":0},"mode":4})";
  const auto loaded = load(file.bytes());
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(loaded.value().scene.meshes[0].geometries.size(), 1u);
  ASSERT_EQ(loaded.value().warnings.size(), 1u);
  EXPECT_NE(loaded.value().warnings[0].find("points or lines"), std::string::npos);
}

/// Reads positions of one integer component type, normalised or not.
template <class T>
glm::vec3 largest_position(int component_type, bool normalized) {
  Glb glb;
  const T one = std::numeric_limits<T>::max();
  const std::size_t stride = (3 * sizeof(T) + 3) / 4 * 4 / sizeof(T);
  std::vector<T> values(stride * 3, T{0});
  values[0] = one;
  values[stride + 1] = one;
  values[2 * stride + 2] = one;
  glb.add(values);
  const auto loaded = load(glb.bytes(
      "\"accessors\":[{\"bufferView\":0,\"componentType\":" + std::to_string(component_type) +
      ",\"count\":3,\"type\":\"VEC3\",\"normalized\":" + (normalized ? "true" : "false") +
      "}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":" + std::to_string(glb.size()) +
      ",\"byteStride\":" + std::to_string(stride * sizeof(T)) +
      "}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":"
      "0}]"));
  EXPECT_TRUE(loaded.ok()) << loaded.error().message;
  if (!loaded.ok()) return glm::vec3(0.0f);
  const Bounds box = scene_bounds(loaded.value().scene);
  return glm::vec3(box.max);
}

TEST(GltfLoad, EveryComponentType) {
  EXPECT_EQ(largest_position<std::int8_t>(5120, false), glm::vec3(127));
  EXPECT_EQ(largest_position<std::uint8_t>(5121, false), glm::vec3(255));
  EXPECT_EQ(largest_position<std::int16_t>(5122, false), glm::vec3(32767));
  EXPECT_EQ(largest_position<std::uint16_t>(5123, false), glm::vec3(65535));
  EXPECT_EQ(largest_position<std::uint32_t>(5125, false), glm::vec3(4294967296.0f));
  EXPECT_EQ(largest_position<std::int8_t>(5120, true), glm::vec3(1));
  EXPECT_EQ(largest_position<std::uint8_t>(5121, true), glm::vec3(1));
  EXPECT_EQ(largest_position<std::int16_t>(5122, true), glm::vec3(1));
  EXPECT_EQ(largest_position<std::uint16_t>(5123, true), glm::vec3(1));
}

TEST(GltfLoad, SparseAccessorReplacesElements) {
  Glb glb;
  glb.add(kQuad);
  const std::size_t ids = glb.add(std::vector<std::uint16_t>{1, 3});
  const std::size_t values = glb.add(std::vector<float>{9, 0, 0, 9, 9, 0});
  const auto file = [&](const std::string& base, const std::string& count) {
    return glb.bytes(
        "\"accessors\":[{" + base +
        "\"componentType\":5126,\"count\":4,\"type\":\"VEC3\",\"sparse\":{\"count\":" + count +
        ",\"indices\":{\"bufferView\":1,\"componentType\":5123},\"values\":{\"bufferView\":2}}}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":" +
        std::to_string(ids) +
        ",\"byteLength\":4},{\"buffer\":0,\"byteOffset\":" + std::to_string(values) +
        ",\"byteLength\":24}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
        "\"mode\":5}]}],\"nodes\":[{\"mesh\":0}]");
  };
  const auto replaced = load(file("\"bufferView\":0,", "2"));
  ASSERT_TRUE(replaced.ok()) << replaced.error().message;
  EXPECT_EQ(scene_bounds(replaced.value().scene).max, glm::dvec3(9, 9, 0));
  const auto zeros = load(file("", "2"));
  ASSERT_TRUE(zeros.ok()) << zeros.error().message;
  EXPECT_EQ(scene_bounds(zeros.value().scene).min, glm::dvec3(0, 0, 0));
  expect_error(load(file("\"bufferView\":0,", "3")), "sparse indices: needs 6 bytes");
  expect_error(load(file("\"bufferView\":0,", "5")), "sparse: count is 5, 0..4");
}

TEST(GltfLoad, NodeTransformsMultiply) {
  QuadFile file;
  file.nodes = R"([{"children":[1],"translation":[10,0,0],"rotation":[0,0,0.70710678,0.70710678]},)"
               R"({"mesh":0,"scale":[2,-3,1],"translation":[1,0,0]},)"
               R"({"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]}])";
  const auto loaded = load(file.bytes());
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  ASSERT_EQ(loaded.value().scene.instances.size(), 2u);
  const Instance& first = loaded.value().scene.instances[0];
  // (1,1,0) -> scale (2,-3,0) -> move (3,-3,0) -> quarter turn (3,3,0) -> move (13,3,0).
  const glm::dvec4 p = first.transform * glm::dvec4(1, 1, 0, 1);
  EXPECT_NEAR(p.x, 13.0, 1e-6);
  EXPECT_NEAR(p.y, 3.0, 1e-6);
  EXPECT_TRUE(is_mirrored(first));
  EXPECT_EQ(glm::dvec3(loaded.value().scene.instances[1].transform[3]), glm::dvec3(5, 6, 7));
}

TEST(GltfLoad, SingularInstancesAreLeftOut) {
  QuadFile file;
  file.nodes = R"([{"mesh":0,"scale":[0,1,1],"name":"flat"},{"mesh":0}])";
  const auto loaded = load(file.bytes());
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(loaded.value().scene.instances.size(), 1u);
  ASSERT_EQ(loaded.value().warnings.size(), 1u);
  EXPECT_NE(loaded.value().warnings[0].find("flat"), std::string::npos);
}

const MaterialConstants& material_of(const Result<LoadedScene>& loaded) {
  return loaded.value().scene.materials.at(0).constants;
}

TEST(GltfLoad, MaterialsAndTextures) {
  const auto loaded = load(textured(
      R"({"name":"m","doubleSided":true,"emissiveFactor":[0.5,1,0],"extensions":{)"
      R"("KHR_materials_emissive_strength":{"emissiveStrength":4}},"pbrMetallicRoughness":{)"
      R"("baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0.5,"roughnessFactor":0.25,)"
      R"("baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{)"
      R"("offset":[0.25,0.5],"rotation":1.5707963267948966,"scale":[2,3]}}}}})"));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const MaterialConstants& m = material_of(loaded);
  EXPECT_EQ(m.base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(m.emissive, glm::vec3(2, 4, 0));
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.roughness, 0.25f);
  EXPECT_EQ(m.flags, kMaterialDoubleSided);
  ASSERT_EQ(m.image[kBaseColorTexture], 0);
  EXPECT_EQ(m.image[kNormalTexture], kNoTexture);
  const Scene& scene = loaded.value().scene;
  EXPECT_TRUE(scene.images[0].srgb);
  EXPECT_EQ(scene.images[0].mips[0][1], 100);
  const Sampler& sampler = scene.samplers.at(m.sampler[kBaseColorTexture]);
  EXPECT_EQ(sampler.wrap_u, Wrap::kClamp);
  EXPECT_EQ(sampler.wrap_v, Wrap::kMirror);
  EXPECT_EQ(sampler.mag_filter, Filter::kNearest);
  EXPECT_FALSE(sampler.mipmapped);
  // A quarter turn maps u to -v: (1, 0), scaled to (2, 0), becomes (0, -2).
  const glm::vec4& t = m.uv_matrix[kBaseColorTexture];
  EXPECT_NEAR(t.x, 0.0f, 1e-6f);
  EXPECT_NEAR(t.z, -2.0f, 1e-6f);
  EXPECT_NEAR(t.y, 3.0f, 1e-6f);
  EXPECT_EQ(m.uv_offset[kBaseColorTexture], glm::vec2(0.25f, 0.5f));
}

TEST(GltfLoad, AlphaModes) {
  const std::string texture = R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}})";
  const auto mask = load(textured(R"({"alphaMode":"MASK","alphaCutoff":0.3,)" + texture + "}"));
  ASSERT_TRUE(mask.ok()) << mask.error().message;
  EXPECT_EQ(material_of(mask).flags, kMaterialMask | kMaterialAlphaTested);
  EXPECT_EQ(material_of(mask).alpha_cutoff, 0.3f);
  EXPECT_TRUE(mask.value().scene.meshes[0].geometries[0].alpha_tested);

  const auto blend = load(textured(R"({"alphaMode":"BLEND",)" + texture + "}"));
  ASSERT_TRUE(blend.ok()) << blend.error().message;
  EXPECT_EQ(material_of(blend).flags, kMaterialBlend | kMaterialAlphaTested);
  EXPECT_EQ(material_of(blend).alpha_cutoff, 0.5f) << "shadow rays know open or closed";
  EXPECT_EQ(blend.value().scene.instances[0].mask, kMaskOpaque);

  const auto glass = load(textured(R"({"alphaMode":"BLEND"})"));
  ASSERT_TRUE(glass.ok()) << glass.error().message;
  EXPECT_EQ(material_of(glass).flags, kMaterialBlend);
  EXPECT_FALSE(glass.value().scene.meshes[0].geometries[0].alpha_tested);
  EXPECT_EQ(glass.value().scene.instances[0].mask, kMaskTransparent);

  const auto opaque = load(textured("{" + texture + "}"));
  ASSERT_TRUE(opaque.ok()) << opaque.error().message;
  EXPECT_FALSE(opaque.value().scene.meshes[0].geometries[0].alpha_tested);
  expect_error(load(textured(R"({"alphaMode":"HOLES"})")), "OPAQUE, MASK and BLEND are allowed");
}

TEST(GltfLoad, CamerasAndLights) {
  QuadFile file;
  file.nodes =
      R"([{"mesh":0},{"camera":0,"translation":[0,2,9],"scale":[3,3,3]},)"
      R"({"extensions":{"KHR_lights_punctual":{"light":0}},"rotation":[-0.70710678,0,0,0.70710678]},)"
      R"({"extensions":{"KHR_lights_punctual":{"light":1}},"translation":[1,2,3],)"
      R"("extras":{"kaamos":{"lamp":{"baked":false}}}}])";
  file.more =
      R"(,"cameras":[{"type":"perspective","name":"c","perspective":{"yfov":0.7,"znear":0.1}}],)"
      R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[)"
      R"({"type":"directional","intensity":5,"color":[1,0.5,0.25]},)"
      R"({"type":"spot","intensity":7,"range":4,"spot":{"innerConeAngle":0.2,"outerConeAngle":0.5}}]}})";
  const auto loaded = load(file.bytes());
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const Scene& scene = loaded.value().scene;
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].vertical_fov, 0.7);
  EXPECT_EQ(scene.cameras[0].position(), glm::dvec3(0, 2, 9));
  EXPECT_NEAR(scene.cameras[0].forward().z, -1.0, 1e-9);
  // Light travels along -z; rotated by -90 degrees about x, that is downwards.
  EXPECT_NEAR(scene.sun->direction_to_sun.y, 1.0f, 1e-6f);
  EXPECT_EQ(scene.sun->irradiance, glm::vec3(5, 2.5f, 1.25f));
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].type, LightType::kSpot);
  EXPECT_EQ(scene.lights[0].position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene.lights[0].outer_cone_angle, 0.5f);
  EXPECT_FALSE(scene.lights[0].baked);
}

// There is one sun: the strongest directional light. Loading names those that do not count.
TEST(GltfLoad, SaysWhichDirectionalLightsDoNotCount) {
  QuadFile file;
  file.nodes = R"([{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":0}}},)"
               R"({"extensions":{"KHR_lights_punctual":{"light":1}}}])";
  file.more =
      R"(,"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[)"
      R"({"type":"directional","intensity":2,"name":"fill"},)"
      R"({"type":"directional","intensity":5,"name":"key"}]}})";
  const auto loaded = load(file.bytes());
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(loaded.value().scene.sun->irradiance, glm::vec3(5));
  ASSERT_EQ(loaded.value().warnings.size(), 1u);
  EXPECT_NE(loaded.value().warnings[0].find("\"fill\" is left out: \"key\""), std::string::npos)
      << loaded.value().warnings[0];
}

TEST(GltfLoad, SkinnedMeshesStandInTheirPose) {
  Glb glb;
  glb.add(kQuad);
  // The lower two vertices follow joint 0, the upper two follow both joints in equal parts.
  const std::size_t joints =
      glb.add(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
  const std::size_t weights =
      glb.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0.5f, 0.5f, 0, 0});
  const auto file = [&](const std::string& skin_joints) {
    return glb.bytes(
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
        R"({"bufferView":1,"componentType":5121,"count":4,"type":"VEC4"},)"
        R"({"bufferView":2,"componentType":5126,"count":4,"type":"VEC4"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":)" +
        std::to_string(joints) + R"(,"byteLength":16},{"buffer":0,"byteOffset":)" +
        std::to_string(weights) +
        R"(,"byteLength":64}],)"
        R"("meshes":[{"primitives":[{"mode":5,"attributes":{"POSITION":0,"JOINTS_0":1,)"
        R"("WEIGHTS_0":2}}]}],"skins":[{"joints":)" +
        skin_joints +
        R"(}],"nodes":[{"mesh":0,"skin":0,"translation":[50,0,0]},{"translation":[0,0,1]},)"
        R"({"translation":[0,4,0]}])");
  };
  const auto loaded = load(file("[1,2]"));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const Bounds box = scene_bounds(loaded.value().scene);
  // The node's own transform does not apply. The upper vertices are the mean of (y+0, 1) and (y+4,
  // 0).
  EXPECT_EQ(box.min, glm::dvec3(0, 0, 0.5));
  EXPECT_EQ(box.max, glm::dvec3(1, 3, 1));
  EXPECT_EQ(loaded.value().scene.meshes.size(), 1u) << "the bind pose is not kept";
  expect_error(load(file("[1]")), "names joint 1 of 1");
  expect_error(load(file("[1,9]")), "names joint node 9 of 3");
}

// The same quad, whose second joint rises by 2 m in one second; a second node rotates with its
// parent.
TEST(GltfLoad, SkinsAndAnimationsAreKept) {
  Glb glb;
  glb.add(kQuad);
  const std::size_t joints =
      glb.add(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
  const std::size_t weights =
      glb.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0.5f, 0.5f, 0, 0});
  const std::size_t times = glb.add(std::vector<float>{0, 1});
  const std::size_t lifts = glb.add(std::vector<float>{0, 4, 0, 0, 6, 0});
  const auto view = [](std::size_t offset, std::size_t bytes) {
    return R"({"buffer":0,"byteOffset":)" + std::to_string(offset) + R"(,"byteLength":)" +
           std::to_string(bytes) + "}";
  };
  const auto file = [&](const std::string& sampler, const std::string& skin_joints = "[1,2]") {
    return glb.bytes(
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
        R"({"bufferView":1,"componentType":5121,"count":4,"type":"VEC4"},)"
        R"({"bufferView":2,"componentType":5126,"count":4,"type":"VEC4"},)"
        R"({"bufferView":3,"componentType":5126,"count":2,"type":"SCALAR"},)"
        R"({"bufferView":4,"componentType":5126,"count":2,"type":"VEC3"}],"bufferViews":[)" +
        view(0, 48) + "," + view(joints, 16) + "," + view(weights, 64) + "," + view(times, 8) +
        "," + view(lifts, 24) +
        R"(],"meshes":[{"primitives":[{"mode":5,"attributes":{"POSITION":0,"JOINTS_0":1,)"
        R"("WEIGHTS_0":2}}]},{"primitives":[{"mode":5,"attributes":{"POSITION":0}}]}],)"
        R"("skins":[{"joints":)" +
        skin_joints +
        R"(}],"nodes":[{"mesh":0,"skin":0,"translation":[50,0,0]},{"translation":[0,0,1]},)"
        R"({"translation":[0,4,0],"children":[3]},{"mesh":1,"translation":[7,0,0]}],)"
        R"("animations":[{"channels":[{"sampler":0,"target":{"node":2,"path":"translation"}}],)"
        R"("samplers":[)" +
        sampler + "]}]");
  };
  const auto load_animated = [](const std::vector<std::uint8_t>& bytes) {
    return load_gltf_memory(bytes, "test.glb", ".", {.animated = true});
  };
  const auto loaded = load_animated(file(R"({"input":3,"output":4})"));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const Scene& scene = loaded.value().scene;
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.skins.at(0).joints.size(), 2u);
  EXPECT_EQ(scene.animations.at(0).duration, 1.0);
  const Bounds box = scene_bounds(scene);
  EXPECT_EQ(box.min, glm::dvec3(0, 0, 0));
  EXPECT_EQ(box.max, glm::dvec3(8, 5, 1));  // the second quad follows the second joint
  for (const double seconds : {0.0, 0.5, 1.75}) {
    const auto states = evaluate_instances(scene, seconds);
    const double lift = 4 + 2 * (seconds - std::floor(seconds));
    double top = 0;
    for (const Vertex& v : skin_vertices(scene.meshes[0], states[0].joints)) {
      top = std::max(top, static_cast<double>(v.position.y));
    }
    EXPECT_NEAR(top, 1 + 0.5 * lift, 1e-6) << seconds;
    EXPECT_EQ(states[1].transform[3], glm::dvec4(7, lift, 0, 1));
  }
  expect_error(load_animated(file(R"({"input":3,"output":4})", "[1]")), "names joint 1 of 1");
  expect_error(load_animated(file(R"({"input":4,"output":4})")), "animation 0");
  expect_error(load_animated(file(R"({"input":3,"output":4,"interpolation":"CUBICSPLINE"})")),
               "2 times");
  const auto stepped = load_animated(file(R"({"input":3,"output":4,"interpolation":"STEP"})"));
  ASSERT_TRUE(stepped.ok()) << stepped.error().message;
  EXPECT_EQ(evaluate_instances(stepped.value().scene, 0.9)[1].transform[3].y, 4.0);

  // Truncated or altered files are either refused or valid.
  const std::vector<std::uint8_t> good = file(R"({"input":3,"output":4})");
  int refused = 0;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    std::vector<std::uint8_t> bytes = good;
    for (std::uint32_t k = 0; k <= i % 3; ++k) {
      const std::uint32_t h = hash_combine(i, k);
      bytes[h % bytes.size()] = static_cast<std::uint8_t>(pcg_hash(h) >> 24);
    }
    const auto changed = load_animated(bytes);
    refused += !changed.ok();
    if (!changed.ok()) continue;
    ASSERT_TRUE(validate(changed.value().scene).ok()) << i;
    EXPECT_EQ(evaluate_instances(changed.value().scene, 0.3).size(),
              changed.value().scene.instances.size());
  }
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace kaamos::effects
