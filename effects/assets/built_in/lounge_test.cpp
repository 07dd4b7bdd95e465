// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/lounge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <span>

namespace kaamos::effects {
namespace {

const Scene& lounge() {
  static const Scene scene = make_lounge();
  return scene;
}

const Instance* find_instance(const std::string& name) {
  for (const Instance& instance : lounge().instances)
    if (instance.name == name) return &instance;
  return nullptr;
}

TEST(Lounge, IsValid) {
  const Status status = validate(lounge());
  EXPECT_TRUE(status.ok()) << status.error().message;
}

TEST(Lounge, HasTheTrianglesItPromises) {
  EXPECT_GE(instanced_triangle_count(lounge()), 200'000u);
  EXPECT_LE(instanced_triangle_count(lounge()), 500'000u);
  EXPECT_LT(unique_triangle_count(lounge()), instanced_triangle_count(lounge()));
}

TEST(Lounge, FourChairsShareOneMeshOfFivePieces) {
  const Instance* first = find_instance("chair 1");
  ASSERT_NE(first, nullptr);
  const Mesh& mesh = lounge().meshes[first->mesh];
  EXPECT_EQ(mesh.geometries.size(), 5u);
  int chairs = 0;
  for (const Instance& instance : lounge().instances) chairs += instance.mesh == first->mesh;
  EXPECT_EQ(chairs, 4);
  std::map<std::uint32_t, int> materials;
  for (const Geometry& geometry : mesh.geometries) ++materials[geometry.material];
  EXPECT_EQ(materials.size(), 5u) << "each piece has its own material";
}

TEST(Lounge, OnlyLeavesAreAlphaTested) {
  int tested = 0;
  for (const Mesh& mesh : lounge().meshes)
    for (const Geometry& g : mesh.geometries) {
      const MaterialConstants& material = lounge().materials[g.material].constants;
      EXPECT_EQ(g.alpha_tested, (material.flags & kMaterialAlphaTested) != 0) << mesh.name;
      tested += g.alpha_tested;
    }
  EXPECT_EQ(tested, 1);
}

// A thing that glows beside a local light is that light's picture: an instance of its own, as
// bright as the lamp, so that no ray meets the light twice.
TEST(Lounge, BulbsAreThePicturesOfTheirLamps) {
  int lamps = 0;
  for (const Light& light : lounge().lights) {
    if (light.name != "lamp") continue;
    ++lamps;
    int bulbs = 0;
    for (const Instance& instance : lounge().instances) {
      if (instance.mask != kMaskEmissiveProxy) continue;
      Scene one = lounge();
      one.instances = {instance};
      const Bounds box = scene_bounds(one);
      if (glm::distance(box.center(), light.position) > 1e-6) continue;
      ++bulbs;
      EXPECT_NEAR(0.5 * (box.max.y - box.min.y), light.radius, 1e-6);
      const Geometry& geometry = lounge().meshes[instance.mesh].geometries.at(0);
      const glm::vec3 emissive = lounge().materials[geometry.material].constants.emissive;
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(emissive[c] * 3.14159265f * light.radius * light.radius,
                    light.color[c] * light.intensity, 1e-4);
      }
    }
    EXPECT_EQ(bulbs, 1);
  }
  EXPECT_EQ(lamps, 2);
  const glm::vec3 dark(0.0f);
  for (const Instance& instance : lounge().instances) {
    if (instance.mask == kMaskEmissiveProxy || instance.name == "dome") continue;
    for (const Geometry& geometry : lounge().meshes[instance.mesh].geometries) {
      EXPECT_EQ(lounge().materials[geometry.material].constants.emissive, dark) << instance.name;
    }
  }
}

TEST(Lounge, LeafTextureHasHoles) {
  const auto leaf =
      static_cast<std::size_t>(lounge().materials.at(18).constants.image[kBaseColorTexture]);
  const TextureImage& image = lounge().images.at(leaf);
  EXPECT_EQ(image.name, "leaf");
  const float coverage = alpha_coverage(image, 0, 0.5f);
  EXPECT_GT(coverage, 0.3f);
  EXPECT_LT(coverage, 0.8f);
  // Leaves must not thin out in small mips.
  EXPECT_NEAR(alpha_coverage(image, 3, 0.5f), coverage, 0.03f);
}

TEST(Lounge, FrontFacesAndNormalsAgree) {
  for (const Mesh& mesh : lounge().meshes)
    for (const Geometry& g : mesh.geometries) {
      std::uint32_t flipped = 0;
      for (std::uint32_t t = 0; t < g.index_count / 3; ++t) {
        const Vertex& a = mesh.corner(g, t, 0);
        const Vertex& b = mesh.corner(g, t, 1);
        const Vertex& c = mesh.corner(g, t, 2);
        const glm::vec3 n = glm::cross(b.position - a.position, c.position - a.position);
        flipped += glm::dot(n, a.normal + b.normal + c.normal) < 0.0f;
      }
      EXPECT_EQ(flipped, 0u) << mesh.name << ", " << lounge().materials[g.material].name;
    }
}

TEST(Lounge, NormalsAndTangentsAreUnitVectors) {
  for (const Mesh& mesh : lounge().meshes)
    for (const Geometry& g : mesh.geometries) {
      std::uint32_t bad = 0;
      for (const Vertex& v : std::span(mesh.vertices).subspan(g.first_vertex, g.vertex_count)) {
        const glm::vec3 t(v.tangent);
        // Written so that NaN counts as bad.
        bad += !(std::abs(glm::dot(v.normal, v.normal) - 1.0f) < 1e-4f &&
                 std::abs(glm::dot(t, t) - 1.0f) < 1e-4f &&
                 std::abs(glm::dot(t, v.normal)) < 1e-3f && std::abs(v.tangent.w) == 1.0f);
      }
      EXPECT_EQ(bad, 0u) << mesh.name << ", " << lounge().materials[g.material].name;
    }
}

TEST(Lounge, FurnitureStandsOnTheFloorInsideTheRoom) {
  for (const Instance& instance : lounge().instances) {
    if (instance.name == "room" || instance.name == "dome") continue;
    if (instance.mask == kMaskEmissiveProxy) continue;  // a bulb stands in its lamp
    Scene one = lounge();
    one.instances = {instance};
    const Bounds box = scene_bounds(one);
    EXPECT_GE(box.min.y, -1e-6) << instance.name;
    EXPECT_LT(box.min.y, 0.46) << instance.name;
    EXPECT_GT(box.min.x, -6.0) << instance.name;
    EXPECT_LT(box.max.x, 6.0) << instance.name;
    EXPECT_GT(box.min.z, -5.0) << instance.name;
    EXPECT_LT(box.max.z, 5.0) << instance.name;
    EXPECT_LT(box.max.y, 4.0) << instance.name;
  }
}

TEST(Lounge, IsTheSameAtEveryCall) {
  const Scene again = make_lounge();
  ASSERT_EQ(again.meshes.size(), lounge().meshes.size());
  for (std::size_t i = 0; i < again.meshes.size(); ++i) {
    const Mesh& a = again.meshes[i];
    const Mesh& b = lounge().meshes[i];
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    EXPECT_EQ(a.indices, b.indices);
    EXPECT_EQ(
        0, std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(Vertex)));
  }
}

}  // namespace
}  // namespace kaamos::effects
