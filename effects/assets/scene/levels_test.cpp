// SPDX-License-Identifier: MIT
#include "effects/assets/scene/levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "effects/assets/gltf/gltf_test_support.h"
#include "effects/assets/gltf/gltf_write.h"
#include "effects/assets/scene/shapes.h"

namespace kaamos::effects {
namespace {

// A box of radius 1 in `count` levels, seen from `distance` along z by a camera of 90 degrees.
Scene boxes(std::size_t count, double distance) {
  Scene scene;
  scene.name = "boxes";
  scene.materials.emplace_back();
  scene.samplers.emplace_back();
  Instance instance;
  instance.name = "box";
  const std::vector<float> coverages = default_coverages(count);
  for (std::size_t i = 0; i < count; ++i) {
    Mesh mesh;
    mesh.name = "level " + std::to_string(i);
    add_shape(mesh, box(glm::dvec3(1 / std::sqrt(3.0))), 0);
    scene.meshes.push_back(std::move(mesh));
    instance.levels.push_back({static_cast<std::uint32_t>(i), coverages[i]});
  }
  scene.instances.push_back(instance);
  Camera camera;
  camera.vertical_fov = 1.5707963267948966;
  camera.camera_to_world = look_at(glm::dvec3(0, 0, distance), glm::dvec3(0));
  scene.cameras.push_back(camera);
  return scene;
}

TEST(Levels, CoverageIsTheSphereOverHalfTheHeight) {
  const Scene scene = boxes(1, 8);
  const Bounds bounds = scene.meshes[0].bounds();
  EXPECT_NEAR(screen_coverage(bounds, glm::dmat4(1), scene.cameras[0]), 1.0 / 8, 1e-6);
  EXPECT_NEAR(screen_coverage(bounds, glm::dmat4(glm::dmat3(2)), scene.cameras[0]), 2.0 / 8, 1e-6);
  EXPECT_TRUE(std::isinf(screen_coverage(bounds, glm::dmat4(glm::dmat3(9)), scene.cameras[0])));
  EXPECT_EQ(screen_coverage(Bounds{}, glm::dmat4(1), scene.cameras[0]), 0);
}

TEST(Levels, FartherIsCoarser) {
  EXPECT_EQ(default_coverages(4), (std::vector<float>{0.5f, 0.25f, 0.125f, 0.0f}));
  const std::pair<double, std::uint32_t> rows[] = {{0.5, 0}, {1.9, 0}, {2.1, 1}, {3.9, 1},
                                                   {4.1, 2}, {7.9, 2}, {8.1, 3}, {1e6, 3}};
  for (const auto& [distance, level] : rows) {
    Scene scene = boxes(4, distance);
    EXPECT_EQ(select_levels(scene, scene.cameras[0]), std::vector<std::uint32_t>{level})
        << "at " << distance << " m";
    show_levels(scene, scene.cameras[0]);
    EXPECT_EQ(scene.instances[0].mesh, level);
    EXPECT_TRUE(validate(scene).ok()) << validate(scene).error().message;
  }
  // Its present distance counts, not the original one.
  const Scene scene = boxes(4, 1);
  const std::vector<glm::dmat4> away = {look_at(glm::dvec3(0, 0, -5), glm::dvec3(0, 0, -6))};
  EXPECT_EQ(select_levels(scene, scene.cameras[0], away), std::vector<std::uint32_t>{2u});
}

TEST(Levels, NamesTellThem) {
  const auto scene_of = [](const std::vector<std::string>& names) {
    Scene scene = boxes(1, 1);
    scene.instances.clear();
    for (const std::string& name : names) {
      Instance instance;
      instance.name = name;
      scene.instances.push_back(instance);
    }
    return scene;
  };
  Scene scene = scene_of({"tree_LOD1", "rock", "tree_LOD0", "tree_LOD2"});
  EXPECT_EQ(join_levels_by_name(scene), 2u);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[1].name, "tree_LOD0");
  EXPECT_EQ(scene.instances[1].levels.size(), 3u);
  for (const std::vector<std::string>& names : {std::vector<std::string>{"a lod0", "b lod1"},
                                                {"lod1", "lod2"},
                                                {"lod0", "lod2"},
                                                {"lod0"},
                                                {"explode0", "explode1 x"},
                                                {"0", "1"}}) {
    scene = scene_of(names);
    EXPECT_EQ(join_levels_by_name(scene), 0u) << names[0];
    EXPECT_EQ(scene.instances.size(), names.size());
  }
  scene = scene_of({"lod0", "lod1"});
  scene.instances[1].transform[3][0] = 1;
  EXPECT_EQ(join_levels_by_name(scene), 0u) << "they stand beside each other";
}

TEST(Levels, OfFilesAndBack) {
  QuadFile file;
  file.nodes = R"([{"mesh":0,"translation":[1,2,3],"extensions":{"MSFT_lod":{"ids":[1,2]}},)"
               R"("extras":{"MSFT_screencoverage":[0.75,0.5,0.125]}},)"
               R"({"mesh":0,"translation":[1,2,3]},{"mesh":0,"translation":[1,2,3]}])";
  file.more = R"(,"scenes":[{"nodes":[0]}],"extensionsUsed":["MSFT_lod"])";
  auto loaded = load(file.bytes());
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_TRUE(loaded.value().warnings.empty());
  for (int round = 0; round < 2; ++round) {
    const Scene& scene = loaded.value().scene;
    ASSERT_EQ(scene.instances.size(), 1u);
    const std::vector<Level>& levels = scene.instances[0].levels;
    ASSERT_EQ(levels.size(), 3u);
    EXPECT_EQ(levels[0].coverage, 0.75f);
    EXPECT_EQ(levels[1].coverage, 0.5f);
    EXPECT_EQ(levels[2].coverage, 0.125f);
    EXPECT_EQ(scene.instances[0].mesh, levels[0].mesh);
    loaded = load(encode_glb(scene).value());
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  }
}

TEST(Levels, BrokenFilesAreUsedAsFarAsTheyGo) {
  QuadFile file;
  file.nodes = R"([{"mesh":0,"extensions":{"MSFT_lod":{"ids":[1,2]}},)"
               R"("extras":{"MSFT_screencoverage":[0.25,0.5]}},)"
               R"({"mesh":0},{"mesh":0,"translation":[1,0,0]}])";
  file.more = R"(,"scenes":[{"nodes":[0]}])";
  const auto loaded = load(file.bytes());
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  ASSERT_EQ(loaded.value().warnings.size(), 2u);
  EXPECT_NE(loaded.value().warnings[0].find("another transform"), std::string::npos);
  EXPECT_NE(loaded.value().warnings[1].find("MSFT_screencoverage"), std::string::npos);
  EXPECT_EQ(loaded.value().scene.instances[0].levels.size(), 2u);
  file.nodes = R"([{"mesh":0,"extensions":{"MSFT_lod":{"ids":[7]}}}])";
  file.more = "";
  expect_error(load(file.bytes()), "MSFT_lod: names node 7 of 1");
}

TEST(Levels, SixOfAnExportedHead) {
  const std::string path = std::string(KAAMOS_SOURCE_DIR) + "/../shared/scenes/suzanne_lods.gltf";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  auto loaded = load_gltf(path);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  Scene& scene = loaded.value().scene;
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].levels.size(), 6u);
  const std::uint64_t finest = instanced_triangle_count(scene);
  scene.cameras.front().camera_to_world[3] += glm::dvec4(0, 0, 1000, 0);
  show_levels(scene, scene.cameras.front());
  EXPECT_LT(instanced_triangle_count(scene), finest / 10);
}

}  // namespace
}  // namespace kaamos::effects
