// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/destruction.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kaamos::effects {
namespace {

double volume(const std::vector<Vertex>& vertices, const Mesh& mesh) {
  const Geometry& g = mesh.geometries[0];
  double sum = 0;
  for (std::uint32_t i = 0; i < g.index_count; i += 3) {
    const auto p = [&](std::uint32_t k) {
      return glm::dvec3(vertices[g.first_vertex + mesh.index(g, i + k)].position);
    };
    sum += glm::dot(p(0), glm::cross(p(1), p(2))) / 6.0;
  }
  return sum;
}

// Before the burst the pieces are the wall without gaps: their volumes add up to its own. After it
// rigid ones have kept theirs, and no piece is below the floor by more than its half size.
TEST(Destruction, PiecesAreTheWall) {
  const Scene scene = make_destruction();
  ASSERT_TRUE(validate(scene).ok());
  const Mesh& wall = scene.meshes[scene.instances[1].mesh];
  EXPECT_EQ(wall.triangle_count(), 12 * kDebrisPieces);
  for (const double seconds : {0.0, kBurstSeconds, 1.0, 1.9}) {
    const auto states = evaluate_instances(scene, seconds);
    const std::vector<Vertex> now = skin_vertices(wall, states[1].joints);
    double least = 0, furthest = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      least = std::min(least, static_cast<double>(now[i].position.y));
      furthest = std::max(
          furthest, static_cast<double>(glm::distance(now[i].position, wall.vertices[i].position)));
      EXPECT_TRUE(std::isfinite(now[i].position.x));
    }
    // Between two keys a turning piece shrinks: linear joints, here by up to a few hundredths.
    EXPECT_NEAR(volume(now, wall), 4.0 * 2.5 * 0.2, seconds > kBurstSeconds ? 0.1 : 1e-4);
    EXPECT_GT(least, -0.2);
    if (seconds > kBurstSeconds) {
      EXPECT_GT(furthest, 1.0) << seconds;
    } else {
      EXPECT_LT(furthest, 1e-5) << seconds;
    }
  }
}

// The curtain hangs still before the burst, is blown away from the wall after it, and its cloth
// is not torn: no edge gets much longer.
TEST(Destruction, TheCurtainFlies) {
  const Scene scene = make_destruction();
  const Mesh& curtain = scene.meshes[scene.instances[2].mesh];
  const auto at = [&](double seconds) {
    return skin_vertices(curtain, evaluate_instances(scene, seconds)[2].joints);
  };
  const std::vector<Vertex> rest = at(0.3), flown = at(1.2);
  double moved = 0, longest = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    EXPECT_LT(glm::distance(rest[i].position, curtain.vertices[i].position), 1e-4f);
    moved = std::max(moved, static_cast<double>(flown[i].position.z - rest[i].position.z));
    EXPECT_NEAR(glm::length(flown[i].normal), 1.0f, 1e-4f);
  }
  const Geometry& g = curtain.geometries[0];
  for (std::uint32_t i = 0; i < g.index_count; ++i) {
    const std::uint32_t a = curtain.index(g, i), b = curtain.index(g, i % 3 == 2 ? i - 2 : i + 1);
    longest =
        std::max(longest, static_cast<double>(glm::distance(flown[a].position, flown[b].position) /
                                              glm::distance(rest[a].position, rest[b].position)));
  }
  EXPECT_GT(moved, 0.3);
  EXPECT_LT(longest, 1.6);
}

}  // namespace
}  // namespace kaamos::effects
