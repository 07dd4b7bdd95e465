// SPDX-License-Identifier: MIT
// Scenes survive writing and loading; real files load.
#include "effects/assets/gltf/gltf_write.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "effects/assets/built_in/lounge.h"
#include "effects/assets/common/file.h"
#include "effects/assets/gltf/gltf_test_support.h"

namespace kaamos::effects {
namespace {

void expect_same_geometry(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t m = 0; m < a.meshes.size(); ++m) {
    ASSERT_EQ(a.meshes[m].geometries.size(), b.meshes[m].geometries.size()) << a.meshes[m].name;
    ASSERT_EQ(a.meshes[m].vertices.size(), b.meshes[m].vertices.size()) << a.meshes[m].name;
    EXPECT_EQ(a.meshes[m].indices, b.meshes[m].indices) << a.meshes[m].name;
    for (std::size_t v = 0; v < a.meshes[m].vertices.size(); ++v) {
      const Vertex& x = a.meshes[m].vertices[v];
      const Vertex& y = b.meshes[m].vertices[v];
      ASSERT_EQ(x.position, y.position);
      ASSERT_EQ(x.uv, y.uv);
      ASSERT_GT(glm::dot(x.normal, y.normal), 0.99999f);
      ASSERT_GT(glm::dot(x.tangent, y.tangent), 1.9999f);
    }
  }
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].name, b.instances[i].name);
    EXPECT_EQ(a.instances[i].mesh, b.instances[i].mesh);
    EXPECT_EQ(a.instances[i].transform, b.instances[i].transform);
  }
}

TEST(GltfWrite, TheLoungeComesBack) {
  const Scene lounge = make_lounge();
  const auto bytes = encode_glb(lounge);
  ASSERT_TRUE(bytes.ok()) << bytes.error().message;
  const auto loaded = load(bytes.value());
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const Scene& back = loaded.value().scene;
  // Lamps' shapes come back by their instances' masks; nothing has to be guessed.
  EXPECT_TRUE(loaded.value().warnings.empty());
  expect_same_geometry(lounge, back);
  for (std::size_t i = 0; i < lounge.instances.size(); ++i) {
    EXPECT_EQ(lounge.instances[i].mask, back.instances[i].mask) << lounge.instances[i].name;
  }
  ASSERT_EQ(back.materials.size(), lounge.materials.size() + 1) << "and the default material";
  for (std::size_t i = 0; i < lounge.materials.size(); ++i) {
    const MaterialConstants& x = lounge.materials[i].constants;
    const MaterialConstants& y = back.materials[i].constants;
    EXPECT_EQ(lounge.materials[i].name, back.materials[i].name);
    EXPECT_EQ(x.base_color, y.base_color);
    EXPECT_EQ(x.flags, y.flags) << lounge.materials[i].name;
    EXPECT_NEAR(glm::distance(x.emissive, y.emissive), 0.0f, 1e-4f);
    for (std::uint32_t slot = 0; slot < kTextureSlotCount; ++slot) {
      ASSERT_EQ(x.image[slot] == kNoTexture, y.image[slot] == kNoTexture);
      if (x.image[slot] == kNoTexture) continue;
      EXPECT_EQ(lounge.images[static_cast<std::size_t>(x.image[slot])].mips[0],
                back.images[static_cast<std::size_t>(y.image[slot])].mips[0]);
      EXPECT_EQ(x.uv_matrix[slot], y.uv_matrix[slot]);
    }
  }
  ASSERT_EQ(back.cameras.size(), lounge.cameras.size());
  EXPECT_NEAR(glm::distance(back.cameras[0].position(), lounge.cameras[0].position()), 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(back.cameras[0].forward(), lounge.cameras[0].forward()), 0.0, 1e-9);
  EXPECT_NEAR(glm::dot(back.sun->direction_to_sun, lounge.sun->direction_to_sun), 1.0f, 1e-6f);
  EXPECT_NEAR(back.sun->irradiance.x, lounge.sun->irradiance.x, 1e-4f);
  EXPECT_EQ(back.lights.size(), lounge.lights.size());
}

TEST(GltfWrite, RefusesABrokenSceneAndKeepsTheEarlierFile) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("kaamos-" + std::to_string(::getpid()) + ".glb"))
          .string();
  Scene scene = load(QuadFile{}.bytes()).value().scene;
  ASSERT_TRUE(write_glb(path, scene).ok());
  const auto before = read_file(path);
  scene.instances[0].mesh = 5;
  const Status status = write_glb(path, scene);
  EXPECT_NE(status.error().message.find("mesh 5 of 1"), std::string::npos)
      << status.error().message;
  EXPECT_EQ(read_file(path).value(), before.value());
  std::filesystem::remove(path);
}

/// A real file in the folder beside the repository. The project does not depend on it.
class RealScene : public ::testing::TestWithParam<std::pair<const char*, int>> {};

TEST_P(RealScene, LoadsWithItsTriangles) {
  const std::string path = std::string(KAAMOS_SOURCE_DIR) + "/../shared/scenes/" + GetParam().first;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const auto loaded = load_gltf(path);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const Scene& scene = loaded.value().scene;
  EXPECT_TRUE(validate(scene).ok());
  EXPECT_EQ(unique_triangle_count(scene), static_cast<std::uint64_t>(GetParam().second));
  const auto bytes = encode_glb(scene);
  ASSERT_TRUE(bytes.ok()) << bytes.error().message;
  const auto again = load(bytes.value());
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ(unique_triangle_count(again.value().scene), unique_triangle_count(scene));
}

INSTANTIATE_TEST_SUITE_P(
    Files, RealScene,
    ::testing::Values(std::pair{"reflection_scene.gltf", 55626},
                      std::pair{"samplebuilding.gltf", 11132},
                      std::pair{"samplebuilding_glass.gltf", 164},
                      std::pair{"sampleroom.gltf", 2180}, std::pair{"chinesedragon.gltf", 100960},
                      std::pair{"suzanne_lods.gltf", 21493}, std::pair{"oaktree.gltf", 5302},
                      std::pair{"plants.gltf", 8870}, std::pair{"CesiumMan.glb", 4672},
                      std::pair{"fireplace.gltf", 1142}, std::pair{"shadowscene_fire.gltf", 3104},
                      std::pair{"teapot.gltf", 9128}),
    [](const auto& test) {
      std::string name = test.param.first;
      return name.substr(0, name.find('.'));
    });

TEST(RealSceneDetails, OakLeavesAreAlphaTested) {
  const std::string path = std::string(KAAMOS_SOURCE_DIR) + "/../shared/scenes/oaktree.gltf";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const auto loaded = load_gltf(path);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  int tested = 0;
  for (const Mesh& mesh : loaded.value().scene.meshes)
    for (const Geometry& geometry : mesh.geometries) tested += geometry.alpha_tested;
  EXPECT_EQ(tested, 1);
}

}  // namespace
}  // namespace kaamos::effects
