// SPDX-License-Identifier: MIT
// Cards with a mask against the same leaves as geometry.
#include "effects/assets/built_in/foliage.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "effects/assets/common/sampling.h"
#include "effects/assets/scene/host_rays_test_support.h"

namespace kaamos::effects {
namespace {

TEST(Foliage, HalfOfACardIsOpen) {
  int leaf = 0;
  for (std::uint32_t y = 0; y < kLeafTexels; ++y) {
    for (std::uint32_t x = 0; x < kLeafTexels; ++x) leaf += is_leaf(x, y);
  }
  EXPECT_NEAR(leaf / static_cast<double>(kLeafTexels * kLeafTexels), 0.5, 0.02);
  const Scene scene = make_foliage({});
  EXPECT_EQ(scene.instances.size(), 2u + 100u);
  EXPECT_EQ(scene.meshes.back().geometries.front().index_count / 6, kLeavesOfTwig);
}

// Rays that respect the mask hit what rays hit in the true geometry, but where they pass a texel's
// edge within rounding; rays that take every hit (a leaf that was made opaque) do not.
TEST(Foliage, MasksAreTheTrueLeaves) {
  const FoliageDesc desc{.twigs = 4};
  FoliageDesc true_desc = desc;
  true_desc.tessellated = true;
  const Scene cards = make_foliage(desc);
  const HostRays card_rays(cards), true_rays(make_foliage(true_desc));
  const auto takes = [&](const HostHit& hit) {
    const Mesh& mesh = cards.meshes[cards.instances[hit.instance].mesh];
    const Geometry& geometry = mesh.geometries[hit.geometry];
    if (!geometry.alpha_tested) return true;
    const auto uv = [&](std::uint32_t corner) {
      return glm::dvec2(mesh.corner(geometry, hit.triangle, corner).uv);
    };
    const glm::dvec2 b = hit.barycentrics;
    const glm::dvec2 at = uv(0) * (1.0 - b.x - b.y) + uv(1) * b.x + uv(2) * b.y;
    const auto texel = [](double v) {
      return std::min(static_cast<std::uint32_t>(v * kLeafTexels), kLeafTexels - 1);
    };
    return is_leaf(texel(at.x), texel(at.y));
  };
  int leaves = 0, solid = 0, different = 0;
  for (std::uint32_t i = 0; i < 500; ++i) {
    const Instance& twig = cards.instances[2 + i % desc.twigs];
    const glm::dvec3 target(twig.transform * glm::dvec4(0.4 * unit_float(pcg_hash(3 * i)) - 0.2,
                                                        unit_float(pcg_hash(3 * i + 1)),
                                                        0.4 * unit_float(pcg_hash(3 * i + 2)) - 0.2,
                                                        1));
    const glm::dvec3 from(0.3, 1.5, 4.0);
    const auto card = card_rays.nearest(from, target - from, takes);
    const auto opaque = card_rays.nearest(from, target - from);
    const auto truth = true_rays.nearest(from, target - from);
    ASSERT_EQ(card.has_value(), truth.has_value()) << i;
    if (!truth) continue;
    leaves += truth->instance >= 2;
    solid += opaque->t < truth->t - 1e-5;
    different += card->instance != truth->instance || std::abs(card->t - truth->t) > 1e-6;
  }
  EXPECT_GT(leaves, 60);
  EXPECT_LE(different, 1);
  EXPECT_GT(solid, leaves / 4);
}

}  // namespace
}  // namespace kaamos::effects
