// SPDX-License-Identifier: MIT
// Tests what files have besides plain triangles: colours, morph targets, further joints, instances,
// extensions. Each is read with the right value, or named in a warning, or refused by its name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "effects/assets/common/file.h"
#include "effects/assets/gltf/gltf_test_support.h"
#include "effects/assets/gltf/gltf_write.h"
#include "effects/assets/scene/animation.h"
#include "effects/assets/scene/pieces.h"

namespace kaamos::effects {
namespace {

/// A file of accessors that lie one after the other in its buffer. Accessor 0 is the quad's
/// positions, 1 its indices.
class File {
 public:
  File() {
    add(kQuad, 5126, "VEC3", 3);
    add(std::vector<std::uint8_t>{0, 1, 2, 2, 1, 3}, 5121, "SCALAR", 1);
  }
  /// Returns the accessor's number as text.
  template <class T>
  std::string add(const std::vector<T>& values, int component_type, const std::string& type,
                  std::size_t components, bool normalized = false) {
    const std::size_t at = glb_.add(values);
    append(views_, R"({"buffer":0,"byteOffset":)" + std::to_string(at) + R"(,"byteLength":)" +
                       std::to_string(values.size() * sizeof(T)) + "}");
    return accessor(R"("bufferView":)" + std::to_string(count_views_++) + R"(,"componentType":)" +
                    std::to_string(component_type) + R"(,"count":)" +
                    std::to_string(values.size() / components) + R"(,"type":")" + type + "\"" +
                    (normalized ? R"(,"normalized":true)" : ""));
  }
  std::string accessor(const std::string& members) {
    append(accessors_, "{" + members + "}");
    return std::to_string(count_accessors_++);
  }
  std::string attributes = R"("POSITION":0)";
  std::string indices = "1";
  std::string primitive;  // further members of it, each preceded by a comma
  std::string mesh;       // of the mesh
  std::string nodes = R"({"mesh":0})";
  std::string more;  // of the file

  std::vector<std::uint8_t> bytes() const {
    return glb_.bytes("\"accessors\":[" + accessors_ + "],\"bufferViews\":[" + views_ +
                      R"(],"meshes":[{"primitives":[{"attributes":{)" + attributes +
                      R"(},"indices":)" + indices + primitive + "}]" + mesh + R"(}],"nodes":[)" +
                      nodes + "]" + more);
  }

 private:
  static void append(std::string& list, const std::string& item) {
    list += (list.empty() ? "" : ",") + item;
  }
  Glb glb_;
  std::string accessors_, views_;
  int count_accessors_ = 0, count_views_ = 0;
};

Scene scene_of(const Result<LoadedScene>& loaded) {
  EXPECT_TRUE(loaded.ok()) << loaded.error().message;
  return loaded.ok() ? loaded.value().scene : Scene{};
}

void expect_warning(const Result<LoadedScene>& loaded, const std::string& part) {
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  bool found = false;
  std::string all;
  for (const std::string& warning : loaded.value().warnings) {
    found |= warning.find(part) != std::string::npos;
    all += warning + "\n";
  }
  EXPECT_TRUE(found) << "wanted: " << part << "\n" << all;
}

Result<LoadedScene> load_animated(const std::vector<std::uint8_t>& bytes) {
  return load_gltf_memory(bytes, "test.glb", ".", {.animated = true});
}

TEST(GltfColors, EveryTypeOfColor) {
  const VertexColor expected[] = {{65535, 0, 0, 65535},
                                  {0, 65535, 0, 65535},
                                  {0, 0, 65535, 65535},
                                  {32896, 32896, 32896, 65535}};
  const auto check = [&](File file, const std::string& accessor) {
    file.attributes +=
        ",\"NORMAL\":" +
        file.add(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 3) +
        ",\"COLOR_0\":" + accessor;
    const auto loaded = load(file.bytes());
    const Scene scene = scene_of(loaded);
    EXPECT_TRUE(loaded.value().warnings.empty());
    ASSERT_EQ(scene.meshes.at(0).colors.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(scene.meshes[0].colors[i], expected[i]) << i;
  };
  const float half = 32896.0f / 65535.0f;
  File floats;
  std::string id =
      floats.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, half, half, half}, 5126, "VEC3", 3);
  check(floats, id);
  File bytes;
  id = bytes.add(
      std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 128, 128, 128, 255},
      5121, "VEC4", 4, true);
  check(bytes, id);
  File shorts;
  id = shorts.add(std::vector<std::uint16_t>{65535, 0, 0, 65535, 0, 65535, 0, 65535, 0, 0, 65535,
                                             65535, 32896, 32896, 32896, 65535},
                  5123, "VEC4", 4, true);
  check(shorts, id);
}

TEST(GltfColors, FlatNormalsPiecesAndFilesKeepThem) {
  File file;
  file.attributes += ",\"COLOR_0\":" + file.add(std::vector<float>{2, 0, 0, 1, 0, 0.5f, 0, 1, 0, 0,
                                                                   0.25f, 1, 1, 1, 1, 0.5f},
                                                5126, "VEC4", 4);
  const auto loaded = load(file.bytes());
  expect_warning(loaded, "COLOR_0: values above 1 are taken as 1");
  const Scene scene = scene_of(loaded);
  const Mesh& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.vertices.size(), 6u) << "a vertex per corner";
  ASSERT_EQ(mesh.colors.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const glm::vec3& p = mesh.vertices[i].position;
    const VertexColor wanted = p.x + p.y == 0   ? VertexColor{65535, 0, 0, 65535}
                               : p.x + p.y == 2 ? VertexColor{65535, 65535, 65535, 32768}
                               : p.x == 1       ? VertexColor{0, 32768, 0, 65535}
                                                : VertexColor{0, 0, 16384, 65535};
    EXPECT_EQ(mesh.colors[i], wanted) << i;
  }
  const auto written = encode_glb(scene);
  ASSERT_TRUE(written.ok()) << written.error().message;
  EXPECT_EQ(scene_of(load(written.value())).meshes.at(0).colors, mesh.colors);
  Scene split = scene;
  ASSERT_EQ(split_into_pieces(split, 1), 1u);
  ASSERT_EQ(split.meshes.size(), 2u);
  EXPECT_EQ(split.meshes[0].colors.size(), 3u);
  EXPECT_TRUE(validate(split).ok());
}

TEST(GltfColors, WhiteOnesTakeNoMemory) {
  File file;
  file.attributes += ",\"COLOR_0\":" + file.add(std::vector<float>(12, 1.0f), 5126, "VEC3", 3);
  EXPECT_TRUE(scene_of(load(file.bytes())).meshes.at(0).colors.empty());
}

TEST(GltfColors, AGeometryWithoutColorsIsWhiteBesideOneThatHasThem) {
  Mesh mesh;
  const std::vector<Vertex> piece(3);
  const std::vector<std::uint32_t> indices = {0, 1, 2};
  mesh.add_geometry(piece, indices, 0, false);
  mesh.add_colors({});
  EXPECT_TRUE(mesh.colors.empty());
  mesh.add_geometry(piece, indices, 0, false);
  const std::vector<VertexColor> red(3, VertexColor{65535, 0, 0, 65535});
  mesh.add_colors(red);
  mesh.add_geometry(piece, indices, 0, false);
  mesh.add_colors({});
  ASSERT_EQ(mesh.colors.size(), 9u);
  EXPECT_EQ(mesh.colors[2], kWhite);
  EXPECT_EQ(mesh.colors[3], red[0]);
  EXPECT_EQ(mesh.colors[8], kWhite);
}

TEST(GltfMorph, TargetsMoveVerticesAtRest) {
  File file;
  const std::string up =
      file.add(std::vector<float>{0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0}, 5126, "VEC3", 3);
  const std::string right =
      file.add(std::vector<float>{2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0}, 5126, "VEC3", 3);
  file.primitive = R"(,"targets":[{"POSITION":)" + up + R"(},{"POSITION":)" + right + "}]";
  EXPECT_EQ(scene_bounds(scene_of(load(file.bytes()))).max, glm::dvec3(1, 1, 0)) << "no weights";
  file.mesh = R"(,"weights":[1,0])";
  file.nodes = R"({"mesh":0},{"mesh":0,"weights":[0.5,1]},{"mesh":0,"weights":[0.5,1]})";
  const auto loaded = load(file.bytes());
  const Scene scene = scene_of(loaded);
  EXPECT_TRUE(loaded.value().warnings.empty());
  ASSERT_EQ(scene.meshes.size(), 2u) << "nodes with the same weights share a mesh";
  EXPECT_EQ(scene.meshes[0].bounds().max, glm::dvec3(1, 2, 0));
  EXPECT_EQ(scene.meshes[1].bounds().min, glm::dvec3(2, 0, 0));
  EXPECT_EQ(scene.meshes[1].bounds().max, glm::dvec3(3, 1.5, 0));
  EXPECT_EQ(scene.instances.at(1).mesh, scene.instances.at(2).mesh);
  const std::string short_one = file.add(std::vector<float>{0, 0, 0}, 5126, "VEC3", 3);
  file.primitive = R"(,"targets":[{"POSITION":)" + short_one + "}]";
  expect_error(load(file.bytes()), "morph target 0, POSITION: has 1 elements, POSITION has 4");
}

/// A quad whose two targets move it up and to the right, by keys at 0, 1 and 3 s.
File morphing(const std::string& interpolation, const std::vector<float>& weights) {
  File file;
  const std::string up =
      file.add(std::vector<float>{0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}, 5126, "VEC3", 3);
  const std::string right =
      file.add(std::vector<float>{2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0}, 5126, "VEC3", 3);
  const std::string times = file.add(std::vector<float>{0, 1, 3}, 5126, "SCALAR", 1);
  const std::string values = file.add(weights, 5126, "SCALAR", 1);
  file.primitive = R"(,"targets":[{"POSITION":)" + up + R"(},{"POSITION":)" + right + "}]";
  file.mesh = R"(,"weights":[0.25,0])";
  file.nodes = R"({"mesh":0},{"mesh":0,"translation":[0,0,5]})";
  file.more = R"(,"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}],)"
              R"("samplers":[{"interpolation":")" +
              interpolation + R"(","input":)" + times + R"(,"output":)" + values + "}]}]";
  return file;
}

/// Where the first corner of instance 0 stands.
glm::vec3 corner_at(const Scene& scene, double seconds) {
  const Scene posed = posed_scene(scene, seconds);
  return posed.meshes.at(posed.instances.at(0).mesh).vertices.at(0).position;
}

TEST(GltfMorph, WeightsAreAnimatedByAllInterpolations) {
  const std::vector<float> keys = {0, 0, 1, 0, 1, 1};
  const auto linear = load_animated(morphing("LINEAR", keys).bytes());
  EXPECT_TRUE(linear.value().warnings.empty());
  const Scene scene = scene_of(linear);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[0].motion.morph, 0);
  EXPECT_EQ(scene.instances[1].motion.morph, kNoIndex) << "no channel moves it";
  EXPECT_EQ(scene.meshes.at(scene.instances[1].mesh).bounds().min.y, 0.25) << "it stays at rest";
  EXPECT_EQ(corner_at(scene, 0.5), glm::vec3(0, 0.5f, 0));
  EXPECT_EQ(corner_at(scene, 2), glm::vec3(1, 1, 0));
  EXPECT_EQ(scene_bounds(scene).max.y, 1.25);
  const Scene stepped = scene_of(load_animated(morphing("STEP", keys).bytes()));
  EXPECT_EQ(corner_at(stepped, 0.9), glm::vec3(0, 0, 0));
  EXPECT_EQ(corner_at(stepped, 1.0), glm::vec3(0, 1, 0));
  // In-tangents, values, out-tangents of both targets, by key. At the middle of a second: half of
  // each value, an eighth of the out-tangent, minus an eighth of the next in-tangent.
  const Scene cubic = scene_of(load_animated(
      morphing("CUBICSPLINE", {0, 0, 0, 0, 4, 0, 2, 0, 1, 0, 0, 0, 0, 0, 1, 1, 0, 0}).bytes()));
  EXPECT_NEAR(corner_at(cubic, 0.5).y, 0.5 + 4.0 / 8 - 2.0 / 8, 1e-6);
  EXPECT_NEAR(corner_at(cubic, 2).x, 2 * 0.5, 1e-6);
  File backwards = morphing("LINEAR", keys);
  const std::string times = backwards.add(std::vector<float>{0, 2, 1}, 5126, "SCALAR", 1);
  backwards.more.replace(backwards.more.find(R"("input":)") + 8, 1, times);
  expect_error(load_animated(backwards.bytes()), "input: element 2 is a time that is not after");
  expect_error(load_animated(morphing("LINEAR", {0, 0, 1, 0, 1}).bytes()),
               "has 3 times and 5 weights, 2 per time are expected for the 2 morph targets");
  EXPECT_EQ(scene_of(load(morphing("LINEAR", keys).bytes())).meshes.at(0).bounds().min.y, 0.25)
      << "what does not move is at rest";
}

TEST(GltfMorph, FlatNormalsTurnWithTheirTriangles) {
  File file = morphing("LINEAR", {0, 0, 1, 0, 1, 0});
  // The right side goes 1 m back: the quad turns by 45 degrees about the y axis.
  const std::string back =
      file.add(std::vector<float>{0, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, -1}, 5126, "VEC3", 3);
  file.primitive = R"(,"targets":[{"POSITION":)" + back + R"(},{"POSITION":)" + back + "}]";
  const Scene posed = posed_scene(scene_of(load_animated(file.bytes())), 1);
  for (const Vertex& vertex : posed.meshes.at(posed.instances.at(0).mesh).vertices) {
    EXPECT_NEAR(vertex.normal.x, std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(vertex.normal.z, std::sqrt(0.5), 1e-6);
  }
}

/// A quad that 5 joints move: each weighs 0.2 and stands 5, 10, ... 25 m to the right.
File five_joints() {
  File file;
  std::vector<std::uint8_t> first, second;
  std::vector<float> first_weights, second_weights;
  for (int v = 0; v < 4; ++v) {
    first.insert(first.end(), {0, 1, 2, 3});
    second.insert(second.end(), {4, 0, 0, 0});
    first_weights.insert(first_weights.end(), {0.1f, 0.2f, 0.2f, 0.2f});
    second_weights.insert(second_weights.end(), {0.3f, 0, 0, 0});
  }
  file.attributes += ",\"JOINTS_0\":" + file.add(first, 5121, "VEC4", 4) +
                     ",\"WEIGHTS_0\":" + file.add(first_weights, 5126, "VEC4", 4) +
                     ",\"JOINTS_1\":" + file.add(second, 5121, "VEC4", 4) +
                     ",\"WEIGHTS_1\":" + file.add(second_weights, 5126, "VEC4", 4);
  file.more = R"(,"skins":[{"joints":[1,2,3,4,5]}])";
  file.nodes = R"({"mesh":0,"skin":0})";
  for (int joint = 1; joint <= 5; ++joint)
    file.nodes += R"(,{"translation":[)" + std::to_string(5 * joint) + ",0,0]}";
  return file;
}

TEST(GltfMorph, TargetsMoveASkinBeforeItsJoints) {
  File file = five_joints();
  const std::string up =
      file.add(std::vector<float>{0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}, 5126, "VEC3", 3);
  const std::string times = file.add(std::vector<float>{0, 1}, 5126, "SCALAR", 1);
  file.primitive = R"(,"targets":[{"POSITION":)" + up + "}]";
  file.more += R"(,"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}],)"
               R"("samplers":[{"input":)" +
               times + R"(,"output":)" + times + "}]}]";
  const Scene scene = scene_of(load_animated(file.bytes()));
  EXPECT_EQ(scene.instances.at(0).motion.morph, 0);
  EXPECT_EQ(scene.instances.at(0).motion.skin, 0);
  const Scene posed = posed_scene(scene, 0.75);
  const Bounds box = posed.meshes.at(posed.instances.at(0).mesh).bounds();
  EXPECT_NEAR(box.min.y, 0.75, 1e-6);
  EXPECT_NEAR(box.min.x, 16.5 / 0.9, 1e-5);
}

TEST(GltfSkins, TheSecondSetOfJointsCounts) {
  const Bounds box = scene_bounds(scene_of(load(five_joints().bytes())));
  // 0.1 * 5 + 0.2 * (10 + 15 + 20) + 0.3 * 25.
  EXPECT_NEAR(box.min.x, 17.0, 1e-5);
  EXPECT_NEAR(box.max.x, 18.0, 1e-5);
}

TEST(GltfSkins, OfFiveJointsThatMoveTheFourStrongestCount) {
  const auto loaded = load_animated(five_joints().bytes());
  expect_warning(loaded, "JOINTS_1, WEIGHTS_1");
  const Scene scene = scene_of(loaded);
  const SkinVertex& skin = scene.meshes.at(0).skin.at(0);
  EXPECT_EQ(skin.joints, glm::u16vec4(4, 1, 2, 3));
  EXPECT_NEAR(skin.weights.x, 1.0f / 3, 1e-6f);
  // (0.3 * 25 + 0.2 * 45) / 0.9.
  EXPECT_NEAR(scene_bounds(scene).min.x, 16.5 / 0.9, 1e-5);
}

TEST(GltfSkins, ASkinWithoutJointsIsRefused) {
  File file;
  file.more = R"(,"skins":[{"joints":[]}])";
  expect_error(load(file.bytes()), "skin 0: has no joints, at least one is required");
  file.more = R"(,"skins":[{"name":"body"}])";
  expect_error(load(file.bytes()), "skin 0 \"body\": has no joints, which glTF requires");
}

TEST(GltfInstancing, EachOfANodesInstancesStandsWhereItSays) {
  File file;
  const std::string places =
      file.add(std::vector<float>{-5, 0, 0, 0, 0, 0, 5, 0, 0}, 5126, "VEC3", 3);
  const std::string turns = file.add(
      std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 127, 0, 0, 0, 0, 127}, 5120, "VEC4", 4, true);
  const std::string sizes =
      file.add(std::vector<float>{1, 1, 1, 1, 1, 1, 2, 2, 2}, 5126, "VEC3", 3);
  const auto node = [&](const std::string& attributes) {
    return R"({"mesh":0,"name":"tree","translation":[0,7,0],"extensions":{)"
           R"("EXT_mesh_gpu_instancing":{"attributes":{)" +
           attributes + "}}}}";
  };
  file.nodes = node("\"TRANSLATION\":" + places + ",\"ROTATION\":" + turns + ",\"SCALE\":" + sizes +
                    ",\"_ID\":" + places);
  file.more = R"(,"extensionsUsed":["EXT_mesh_gpu_instancing"],)"
              R"("extensionsRequired":["EXT_mesh_gpu_instancing"])";
  const auto loaded = load(file.bytes());
  expect_warning(loaded, "the attribute _ID is not read");
  const Scene scene = scene_of(loaded);
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(scene.instances[2].name, "tree 2");
  const auto corner = [&](std::size_t i) {
    return glm::dvec3(scene.instances[i].transform * glm::dvec4(1, 1, 0, 1));
  };
  EXPECT_EQ(corner(0), glm::dvec3(-4, 8, 0));
  EXPECT_LT(glm::distance(corner(1), glm::dvec3(-1, 6, 0)), 1e-12) << "half a turn about z";
  EXPECT_EQ(corner(2), glm::dvec3(7, 9, 0));
  file.nodes = node("\"TRANSLATION\":" + places + ",\"SCALE\":0");
  expect_error(load(file.bytes()), "elements, another attribute has");
}

TEST(GltfInstancing, InstancesOfANodeThatMovesMoveWithIt) {
  File file;
  const std::string places = file.add(std::vector<float>{3, 0, 0, 6, 0, 0}, 5126, "VEC3", 3);
  const std::string times = file.add(std::vector<float>{0, 1}, 5126, "SCALAR", 1);
  const std::string lifts = file.add(std::vector<float>{0, 0, 0, 0, 2, 0}, 5126, "VEC3", 3);
  file.nodes = R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{)"
               R"("TRANSLATION":)" +
               places + "}}}}";
  file.more =
      R"(,"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],)"
      R"("samplers":[{"input":)" +
      times + R"(,"output":)" + lifts + "}]}]";
  const Scene scene = scene_of(load_animated(file.bytes()));
  const auto states = evaluate_instances(scene, 0.5);
  ASSERT_EQ(states.size(), 2u);
  EXPECT_EQ(glm::dvec3(states[0].transform[3]), glm::dvec3(3, 1, 0));
  EXPECT_EQ(glm::dvec3(states[1].transform[3]), glm::dvec3(6, 1, 0));
}

TEST(GltfUnlit, ShowsItsBaseColorAndComesBack) {
  File file;
  file.primitive = R"(,"material":0)";
  file.more = R"(,"extensionsUsed":["KHR_materials_unlit"],"materials":[{"emissiveFactor":[1,1,1],)"
              R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.125,1]},)"
              R"("extensions":{"KHR_materials_unlit":{}}}])";
  const auto loaded = load(file.bytes());
  const Scene scene = scene_of(loaded);
  EXPECT_TRUE(loaded.value().warnings.empty());
  const MaterialConstants& m = scene.materials.at(0).constants;
  EXPECT_EQ(m.flags, kMaterialUnlit);
  EXPECT_EQ(m.emissive, glm::vec3(0)) << "the base colour alone counts";
  EXPECT_EQ(m.base_color, glm::vec4(0.5f, 0.25f, 0.125f, 1));
  EXPECT_EQ(int{scene.instances.at(0).mask}, int{kMaskEmissiveProxy}) << "it lights nothing";
  const auto written = encode_glb(scene);
  ASSERT_TRUE(written.ok()) << written.error().message;
  const auto back = load(written.value());
  EXPECT_EQ(scene_of(back).materials.at(0).constants.flags, kMaterialUnlit);
  EXPECT_TRUE(back.value().warnings.empty());
}

TEST(GltfExtensions, ThoseThatAreNotReadAreNamed) {
  File file;
  file.primitive = R"(,"material":0)";
  file.more = R"(,"extensionsUsed":["KHR_materials_sheen","ACME_sparkle"],)"
              R"("materials":[{"extensions":{"KHR_materials_clearcoat":{},)"
              R"("KHR_materials_emissive_strength":{"emissiveStrength":2}}}])";
  const auto loaded = load(file.bytes());
  expect_warning(loaded, "KHR_materials_sheen is not read: cloth has no sheen");
  expect_warning(loaded, "ACME_sparkle is not read: what it describes is left out");
  expect_warning(loaded, "KHR_materials_clearcoat is not read");
  EXPECT_EQ(loaded.value().warnings.size(), 3u) << "one sentence each";
}

TEST(GltfExtensions, VariantsMayBeRequired) {
  File file;
  file.more = R"(,"extensionsRequired":["KHR_materials_variants"],)"
              R"("extensionsUsed":["KHR_materials_variants"])";
  expect_warning(load(file.bytes()), "KHR_materials_variants is not read: each mesh shows its own");
}

TEST(GltfExtensions, CompressionIsRefusedByName) {
  File file;
  file.more = R"(,"extensionsUsed":["KHR_draco_mesh_compression"])";
  file.primitive = R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0}})";
  expect_warning(load(file.bytes()), "KHR_draco_mesh_compression is not read: the uncompressed");
  file.attributes =
      R"("POSITION":)" + file.accessor(R"("componentType":5126,"count":4,"type":"VEC3")");
  expect_error(load(file.bytes()), "is compressed by KHR_draco_mesh_compression");
  file.more += R"(,"extensionsRequired":["KHR_draco_mesh_compression"])";
  expect_error(load(file.bytes()), "requires the extension KHR_draco_mesh_compression");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":9},)"
                         R"({"byteLength":9,"extensions":{"EXT_meshopt_compression":)"
                         R"({"fallback":true}}}]})"),
               "has no uri");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":9,)"
                         R"("extensions":{"EXT_meshopt_compression":{"fallback":true}}}]})"),
               "is compressed by EXT_meshopt_compression");
}

TEST(GltfExtensions, PicturesOfOtherKindsAreNamed) {
  std::vector<std::uint8_t> bytes =
      textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  const std::string png = "\x89PNG\r\n\x1a\n";
  const auto start =
      std::search(bytes.begin(), bytes.end(), png.begin(), png.end(),
                  [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); });
  ASSERT_NE(start, bytes.end());
  const std::string webp = "RIFF____WEBPVP8 ";
  std::copy(webp.begin(), webp.end(), start);
  expect_error(load(bytes), "is a WebP picture (EXT_texture_webp), PNG and JPEG are read");
}

TEST(GltfDocument, VersionsThatAreNotSupportedAreRefused) {
  expect_error(load_text(R"({"asset":{"version":"2.1","minVersion":"2.1"}})"),
               "needs glTF 2.1 (asset.minVersion), 2.0 is supported");
  expect_error(load_text(R"({"asset":{"version":"1.0"}})"), "is glTF 1.0, 2.0 is supported");
  expect_error(load_text(R"({"asset":{}})"), "has no asset.version");
}

TEST(GltfDocument, SaysWhatAndWhereBeforeTheParserDoes) {
  expect_error(load_text("{\"asset\":{\n  \"version\" \"2.0\"}}"), "mistake at line 2, column 17");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"nodes":[{"name":"n","mesh":"x"}]})"),
               "node 0 \"n\": mesh is not a whole number");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{}]}]})"),
               "mesh 0, primitive 0: has no attributes, which glTF requires");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"images":[{}]})"),
               "image 0: has neither uri nor bufferView");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"cameras":[{"type":"fisheye"}]})"),
               "camera 0: type is \"fisheye\"");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":9,)"
                         R"("uri":"data:application/octet-stream;base64,AAAA"}]})"),
               "buffer 0: byteLength is 9, its data has 3 bytes");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5126,)"
                         R"("count":1,"type":"VEC9"}]})"),
               "accessor 0: type is \"VEC9\"");
  File file;
  file.more = R"(,"animations":[{"channels":[{"sampler":0}],"samplers":[]}])";
  expect_error(load(file.bytes()), "animation 0, channel 0: has no target, which glTF requires");
}

// As the Khronos validator allows.
TEST(GltfDocument, DataMayBeLongerThanItsBufferAndOfAnyMediaType) {
  // The positions (0, 0, 0), (1, 0, 0), (0, 1, 0), and one byte more.
  const auto file = [](const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":")" + uri +
           R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
           R"("componentType":5126,"count":3,"type":"VEC3"}],"meshes":[{"primitives":[)"
           R"({"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]})";
  };
  const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  for (const char* type : {"application/octet-stream", "application/x-anything", ""}) {
    const auto loaded = load_text(file("data:" + std::string(type) + ";base64," + base64 + "BQ=="));
    EXPECT_EQ(scene_bounds(scene_of(loaded)).max, glm::dvec3(1, 1, 0)) << type;
  }
  const std::string path = testing::TempDir() + "kaamos_longer.bin";
  std::vector<std::uint8_t> bytes(40, 0);
  const float one = 1.0f;
  std::memcpy(&bytes[12], &one, 4);
  std::memcpy(&bytes[28], &one, 4);
  ASSERT_TRUE(write_file(path, bytes).ok());
  const std::string text = file("kaamos_longer.bin");
  const auto load_beside = [&] {
    return load_gltf_memory(
        std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), "test.gltf",
        testing::TempDir());
  };
  EXPECT_EQ(scene_bounds(scene_of(load_beside())).max, glm::dvec3(1, 1, 0));
  bytes.resize(30);
  ASSERT_TRUE(write_file(path, bytes).ok());
  expect_error(load_beside(), "has 30 bytes, its byteLength says another number");
  std::remove(path.c_str());
}

// A whole number may be written with a point, and an accessor without a view is all zeros or
// sparse.
TEST(GltfDocument, ReadsWhatTheParserRefuses) {
  File file;
  const std::string which = file.add(std::vector<std::uint8_t>{1, 2}, 5121, "SCALAR", 1);
  const std::string values = file.add(std::vector<std::uint16_t>{1, 2}, 5123, "SCALAR", 1);
  const std::string sparse =
      file.accessor(R"("componentType":5123,"count":3,"type":"SCALAR","sparse":{"count":2,)"
                    R"("indices":{"bufferView":)" +
                    which + R"(,"componentType":5121},"values":{"bufferView":)" + values + "}}");
  file.indices = sparse;
  EXPECT_EQ(unique_triangle_count(scene_of(load(file.bytes()))), 1u);
  file.nodes = R"({"mesh":0.0})";
  EXPECT_EQ(scene_of(load(file.bytes())).instances.size(), 1u);
}

TEST(GltfNodes, ASingularTransformIsSaidWhereNothingElseIsShown) {
  File file;
  file.nodes = R"({"mesh":0,"name":"flat","scale":[1,1,0]})";
  expect_error(load(file.bytes()), "node 0 \"flat\": its transform is singular");
}

TEST(GltfNodes, OrthographicCamerasAreReadAndWritten) {
  File file;
  file.nodes += R"(,{"camera":0,"translation":[0,0,4],"scale":[2,2,2]})";
  const auto with = [&](const std::string& ymag) {
    file.more = R"(,"cameras":[{"name":"plan","type":"orthographic","orthographic":{"xmag":2,)"
                R"("ymag":)" +
                ymag + R"(,"znear":0.25,"zfar":9}}])";
    return load(file.bytes());
  };
  const auto loaded = with("1.5");
  const Scene scene = scene_of(loaded);
  EXPECT_TRUE(loaded.value().warnings.empty());
  const Camera& camera = scene.cameras.at(0);
  EXPECT_EQ(camera.name, "plan");
  EXPECT_EQ(camera.half_height, 1.5) << "a node's scale is no part of its camera's view";
  EXPECT_EQ(camera.near_plane, 0.25);
  EXPECT_EQ(camera.position(), glm::dvec3(0, 0, 4));
  EXPECT_EQ(camera.forward(), glm::dvec3(0, 0, -1));
  const auto written = encode_glb(scene);
  ASSERT_TRUE(written.ok()) << written.error().message;
  const Camera again = scene_of(load(written.value())).cameras.at(0);
  EXPECT_EQ(again.half_height, 1.5);
  EXPECT_EQ(again.camera_to_world, camera.camera_to_world);
  expect_warning(with("-1"), "the ymag of its orthographic camera is not above 0");
}

TEST(GltfTextures, EachTextureHasItsOwnCoordinates) {
  const auto material = [](const std::string& normal) {
    return R"({"normalTexture":{"index":0)" + normal +
           R"(},"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}})";
  };
  const auto both = load(textured(material(R"(,"texCoord":1)")));
  const Scene scene = scene_of(both);
  EXPECT_TRUE(both.value().warnings.empty());
  EXPECT_NE(scene.materials.at(0).constants.image[kBaseColorTexture], kNoTexture);
  EXPECT_NE(scene.materials.at(0).constants.image[kNormalTexture], kNoTexture);
  const auto mixed = load(textured(material("")));
  EXPECT_TRUE(mixed.value().warnings.empty());
  const MaterialConstants& constants = scene_of(mixed).materials.at(0).constants;
  EXPECT_NE(constants.image[kNormalTexture], kNoTexture);
  EXPECT_EQ(constants.second_uv, 1u << kBaseColorTexture) << "tangents are the normal texture's";
  const auto third =
      load(textured(R"({"normalTexture":{"index":0},"emissiveTexture":{"index":0,"texCoord":2},)"
                    R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}})"));
  expect_warning(third, "uses TEXCOORD_2, and the material's others TEXCOORD_0 and TEXCOORD_1");
}

TEST(GltfTextures, FilesKeepTheSecondCoordinates) {
  Scene scene = scene_of(
      load(textured(R"({"normalTexture":{"index":0},"pbrMetallicRoughness":{"baseColorTexture":)"
                    R"({"index":0,"texCoord":1}}})")));
  Mesh& mesh = scene.meshes.at(0);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    mesh.second_uv.emplace_back(0.25f * static_cast<float>(i), 1.0f);
  const auto written = encode_glb(scene);
  ASSERT_TRUE(written.ok()) << written.error().message;
  const Scene again = scene_of(load(written.value()));
  EXPECT_EQ(again.meshes.at(0).second_uv, mesh.second_uv);
  EXPECT_EQ(again.materials.at(0).constants.second_uv, 1u << kBaseColorTexture);
  Scene split = scene;
  ASSERT_EQ(split_into_pieces(split, 1), 1u);
  EXPECT_EQ(split.meshes.at(0).second_uv.size(), 3u);
}

TEST(GltfMaterials, ReflectanceIsReadAndWritten) {
  const Scene scene = scene_of(load(textured(
      R"({"extensions":{"KHR_materials_ior":{"ior":1.33},"KHR_materials_specular":)"
      R"({"specularFactor":0.5,"specularColorFactor":[1,2,0.5],"specularTexture":{"index":0},)"
      R"("specularColorTexture":{"index":0,"texCoord":1,"extensions":)"
      R"({"KHR_texture_transform":{"offset":[0.5,0.25]}}}}}})")));
  const MaterialConstants& c = scene.materials.at(0).constants;
  EXPECT_NEAR(c.dielectric_f0, 0.33 * 0.33 / (2.33 * 2.33), 1e-8);
  EXPECT_EQ(c.specular, 0.5f);
  EXPECT_EQ(c.specular_color, glm::vec3(1, 2, 0.5f));
  ASSERT_NE(c.image[kSpecularTexture], kNoTexture);
  ASSERT_NE(c.image[kSpecularColorTexture], kNoTexture);
  EXPECT_TRUE(scene.images[static_cast<std::size_t>(c.image[kSpecularColorTexture])].srgb);
  EXPECT_FALSE(scene.images[static_cast<std::size_t>(c.image[kSpecularTexture])].srgb);
  EXPECT_EQ(c.uv_offset[kSpecularColorTexture], glm::vec2(0.5f, 0.25f));
  EXPECT_EQ(c.second_uv, 1u << kSpecularColorTexture);
  const auto written = encode_glb(scene);
  ASSERT_TRUE(written.ok()) << written.error().message;
  const auto back = load(written.value());
  EXPECT_TRUE(back.value().warnings.empty());
  const MaterialConstants& again = scene_of(back).materials.at(0).constants;
  EXPECT_EQ(again.dielectric_f0, c.dielectric_f0);
  EXPECT_EQ(again.specular, c.specular);
  EXPECT_EQ(again.specular_color, c.specular_color);
  EXPECT_EQ(again.uv_offset, c.uv_offset);
  EXPECT_EQ(again.second_uv, c.second_uv);
}

TEST(GltfMaterials, GlossinessBecomesRoughness) {
  const auto with = [](const std::string& texture) {
    return load(textured(
        R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0.5,0.25,1,1],)"
        R"("specularFactor":[0.1,0.2,0.3],"glossinessFactor":0.75)" +
            texture + "}}}",
        R"(,"extensionsRequired":["KHR_materials_pbrSpecularGlossiness"])"));
  };
  const auto plain = with("");
  EXPECT_TRUE(plain.value().warnings.empty());
  const MaterialConstants& c = scene_of(plain).materials.at(0).constants;
  EXPECT_EQ(c.base_color, glm::vec4(0.5f, 0.25f, 1, 1));
  EXPECT_EQ(c.metallic, 0.0f);
  EXPECT_EQ(c.roughness, 0.25f);
  EXPECT_EQ(c.dielectric_f0 * c.specular * c.specular_color, glm::vec3(0.1f, 0.2f, 0.3f));
  // Alpha 255 and 0: 1 - 0.75 and 1.
  const Scene scene = scene_of(with(R"(,"specularGlossinessTexture":{"index":0})"));
  const MaterialConstants& textured_ones = scene.materials.at(0).constants;
  EXPECT_EQ(textured_ones.roughness, 1.0f);
  ASSERT_NE(textured_ones.image[kMetallicRoughnessTexture], kNoTexture);
  ASSERT_NE(textured_ones.image[kSpecularColorTexture], kNoTexture);
  const TextureImage& rough =
      scene.images[static_cast<std::size_t>(textured_ones.image[kMetallicRoughnessTexture])];
  EXPECT_EQ(int{rough.mips[0][1]}, 64);
  EXPECT_EQ(int{rough.mips[0][5]}, 255);
}

TEST(GltfMaterials, LightPassesThroughThinGlass) {
  const auto with = [](const std::string& color, const std::string& transmission) {
    return load(textured(R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0,)"
                         R"("baseColorFactor":)" +
                         color + R"(},"extensions":{"KHR_materials_transmission":{)" +
                         transmission + "}}}"));
  };
  const auto clear = with("[1,1,1,1]", R"("transmissionFactor":0.75)");
  EXPECT_TRUE(clear.value().warnings.empty());
  const Scene scene = scene_of(clear);
  EXPECT_EQ(scene.materials.at(0).constants.base_color.a, 0.25f);
  EXPECT_EQ(int{scene.instances.at(0).mask}, int{kMaskTransparent});
  EXPECT_GT(scene_of(with("[1,1,1,1]", R"("transmissionFactor":1)"))
                .materials.at(0)
                .constants.base_color.a,
            0.0f);
  expect_warning(with("[1,0.5,0.5,1]", R"("transmissionFactor":1)"), "glass colours what it");
  const auto textured_glass = with("[1,1,1,1]", R"("transmissionFactor":1,)"
                                                R"("transmissionTexture":{"index":0})");
  expect_warning(textured_glass, "KHR_materials_transmission: its texture is not read");
  EXPECT_EQ(int{scene_of(textured_glass).instances.at(0).mask}, int{kMaskOpaque});
}

TEST(GltfBlend, ATextureThatIsNotCutOutMakesGlass) {
  const auto with_alpha = [](std::uint8_t first, std::uint8_t second, const std::string& more) {
    std::vector<std::uint8_t> values = {200, 100, 50, first, 0, 0, 0, second};
    return textured_with(values, R"({"alphaMode":"BLEND","pbrMetallicRoughness":{)" + more +
                                     R"("baseColorTexture":{"index":0}}})");
  };
  const Scene leaf = scene_of(load(with_alpha(255, 0, "")));
  EXPECT_EQ(leaf.materials.at(0).constants.flags, kMaterialBlend | kMaterialAlphaTested);
  EXPECT_EQ(int{leaf.instances.at(0).mask}, int{kMaskOpaque});
  const Scene veil = scene_of(load(with_alpha(255, 90, "")));
  EXPECT_EQ(veil.materials.at(0).constants.flags, kMaterialBlend);
  EXPECT_EQ(int{veil.instances.at(0).mask}, int{kMaskTransparent});
  const Scene faint = scene_of(load(with_alpha(255, 0, R"("baseColorFactor":[1,1,1,0.4],)")));
  EXPECT_EQ(int{faint.instances.at(0).mask}, int{kMaskTransparent}) << "no texel reaches 0.5";
}

TEST(GltfBlend, GlassInAMeshOfOtherThingsIsAnInstanceOfItsOwn) {
  File file;
  file.primitive = R"(,"material":0},{"attributes":{"POSITION":0},"indices":1,"material":1)";
  file.more = R"(,"materials":[{},{"alphaMode":"BLEND"}])";
  const Scene scene = scene_of(load(file.bytes()));
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(int{scene.instances[0].mask}, int{kMaskOpaque});
  EXPECT_EQ(int{scene.instances[1].mask}, int{kMaskTransparent});
  EXPECT_EQ(scene.meshes.at(scene.instances[1].mesh).geometries.at(0).material, 1u);
}

TEST(GltfTextures, TheVerticesHaveTheCoordinatesOfTheirMaterial) {
  File file;
  file.attributes +=
      ",\"TEXCOORD_0\":" + file.add(std::vector<float>(8, 0.0f), 5126, "VEC2", 2) +
      ",\"TEXCOORD_1\":" +
      file.add(std::vector<float>{0.5f, 0.25f, 0.5f, 0.25f, 0.5f, 0.25f, 0.5f, 0.25f}, 5126, "VEC2",
               2);
  file.primitive = R"(,"material":0)";
  file.more =
      R"(,"textures":[{}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,)"
      R"("texCoord":1}}}])";
  const auto loaded = load(file.bytes());
  expect_warning(loaded, "has no PNG or JPEG source");
  EXPECT_EQ(scene_of(loaded).meshes.at(0).vertices.at(0).uv, glm::vec2(0.5f, 0.25f));
}

}  // namespace
}  // namespace kaamos::effects
