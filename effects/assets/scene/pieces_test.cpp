// SPDX-License-Identifier: MIT
#include "effects/assets/scene/pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "effects/assets/built_in/lounge.h"
#include "effects/assets/built_in/runner.h"

namespace kaamos::effects {
namespace {

// World-space corners, material and alpha test of all visible triangles, in a canonical order.
using WorldTriangle = std::array<double, 11>;
std::vector<WorldTriangle> world_triangles(const Scene& scene) {
  std::vector<WorldTriangle> out;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (const Geometry& geometry : mesh.geometries) {
      for (std::uint32_t t = 0; t < geometry.index_count / 3; ++t) {
        WorldTriangle triangle = {};
        for (std::uint32_t c = 0; c < 3; ++c) {
          const glm::dvec4 p(glm::dvec3(mesh.corner(geometry, t, c).position), 1);
          for (int axis = 0; axis < 3; ++axis) {
            triangle[3 * c + static_cast<std::uint32_t>(axis)] = (instance.transform * p)[axis];
          }
        }
        triangle[9] = geometry.material;
        triangle[10] = geometry.alpha_tested;
        out.push_back(triangle);
      }
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(Pieces, AreSmallAndLoseNothing) {
  Scene scene = make_lounge();
  const std::vector<WorldTriangle> before = world_triangles(scene);
  constexpr std::uint32_t kMost = 4096;
  const auto large = std::count_if(scene.meshes.begin(), scene.meshes.end(),
                                   [](const Mesh& mesh) { return mesh.triangle_count() > kMost; });
  ASSERT_GT(large, 0);
  EXPECT_EQ(split_into_pieces(scene, kMost), static_cast<std::size_t>(large));
  EXPECT_TRUE(validate(scene).ok()) << validate(scene).error().message;
  for (const Mesh& mesh : scene.meshes) EXPECT_LE(mesh.triangle_count(), kMost) << mesh.name;
  EXPECT_EQ(world_triangles(scene), before);
}

// Splitting pays only if a piece is a small part of the room; large triangles get a piece of their
// own.
TEST(Pieces, AreCloseTogether) {
  Scene scene = make_lounge();
  scene.instances.resize(1);
  const double whole = glm::length(scene.meshes[scene.instances[0].mesh].bounds().size());
  split_into_pieces(scene, 2048);
  std::size_t large = 0;
  for (const Instance& instance : scene.instances) {
    large += glm::length(scene.meshes[instance.mesh].bounds().size()) > whole / 4 ? 1 : 0;
  }
  EXPECT_GT(scene.instances.size(), 20u);
  EXPECT_EQ(large, 1u);
}

TEST(Pieces, SkinsAndLevelsStayWhole) {
  Scene scene = make_runner_scene({.crowd = 1, .crowd_poses = 1});
  std::uint64_t triangles = 0;
  for (const Instance& instance : scene.instances) {
    if (instance.motion.skin != kNoIndex) triangles += scene.meshes[instance.mesh].triangle_count();
  }
  split_into_pieces(scene, 8);
  EXPECT_TRUE(validate(scene).ok()) << validate(scene).error().message;
  std::uint64_t after = 0;
  for (const Instance& instance : scene.instances) {
    if (instance.motion.skin != kNoIndex) after += scene.meshes[instance.mesh].triangle_count();
  }
  EXPECT_EQ(after, triangles);
}

TEST(Pieces, OneTriangleEach) {
  Scene scene = make_lounge();
  scene.instances.resize(1);
  scene.meshes.resize(scene.instances[0].mesh + 1);
  const std::vector<WorldTriangle> before = world_triangles(scene);
  split_into_pieces(scene, 0);
  for (const Instance& instance : scene.instances) {
    ASSERT_EQ(scene.meshes[instance.mesh].triangle_count(), 1u);
  }
  EXPECT_EQ(world_triangles(scene), before);
}

}  // namespace
}  // namespace kaamos::effects
