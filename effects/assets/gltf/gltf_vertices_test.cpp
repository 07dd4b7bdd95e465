// SPDX-License-Identifier: MIT
// Tests what vertices have besides positions: colours, morph targets, further joints.
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

TEST(GltfColors, EveryTypeOfColor) {
  const VertexColor expected[] = {{65535, 0, 0, 65535},
                                  {0, 65535, 0, 65535},
                                  {0, 0, 65535, 65535},
                                  {32896, 32896, 32896, 65535}};
  const auto check = [&](GltfFile file, const std::string& accessor) {
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
  GltfFile floats;
  std::string id =
      floats.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, half, half, half}, 5126, "VEC3", 3);
  check(floats, id);
  GltfFile bytes;
  id = bytes.add(
      std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 128, 128, 128, 255},
      5121, "VEC4", 4, true);
  check(bytes, id);
  GltfFile shorts;
  id = shorts.add(std::vector<std::uint16_t>{65535, 0, 0, 65535, 0, 65535, 0, 65535, 0, 0, 65535,
                                             65535, 32896, 32896, 32896, 65535},
                  5123, "VEC4", 4, true);
  check(shorts, id);
}

TEST(GltfColors, FlatNormalsPiecesAndFilesKeepThem) {
  GltfFile file;
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
  GltfFile file;
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
  GltfFile file;
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
GltfFile morphing(const std::string& interpolation, const std::vector<float>& weights) {
  GltfFile file;
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
  GltfFile backwards = morphing("LINEAR", keys);
  const std::string times = backwards.add(std::vector<float>{0, 2, 1}, 5126, "SCALAR", 1);
  backwards.more.replace(backwards.more.find(R"("input":)") + 8, 1, times);
  expect_error(load_animated(backwards.bytes()), "input: element 2 is a time that is not after");
  expect_error(load_animated(morphing("LINEAR", {0, 0, 1, 0, 1}).bytes()),
               "has 3 times and 5 weights, 2 per time are expected for the 2 morph targets");
  EXPECT_EQ(scene_of(load(morphing("LINEAR", keys).bytes())).meshes.at(0).bounds().min.y, 0.25)
      << "what does not move is at rest";
}

TEST(GltfMorph, FlatNormalsTurnWithTheirTriangles) {
  GltfFile file = morphing("LINEAR", {0, 0, 1, 0, 1, 0});
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
GltfFile five_joints() {
  GltfFile file;
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
  GltfFile file = five_joints();
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
  GltfFile file;
  file.more = R"(,"skins":[{"joints":[]}])";
  expect_error(load(file.bytes()), "skin 0: has no joints, at least one is required");
  file.more = R"(,"skins":[{"name":"body"}])";
  expect_error(load(file.bytes()), "skin 0 \"body\": has no joints, which glTF requires");
}

}  // namespace
}  // namespace kaamos::effects
