// SPDX-License-Identifier: MIT
//
// Bottom levels with more primitives than 24 bits count: in full with KAAMOS_FULL=1 (2.4 GiB, 15
// s).
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "runtime/embree/testing/harness.h"

namespace kaamos::embree::testing {
namespace {

// All triangles but those at the ends and about the middle are points, which are never hit: the
// build is quicker and smaller.
void expect_indices(uint32_t bits, rtapi::RaytracingGeometryFlags flags) {
  const uint32_t middle = 1u << bits;
  const std::array seen = {0u, middle - 1, middle, middle + 1, middle + middle / 64};
  GeometryInput input;
  input.flags = flags;
  input.indices.resize(3 * (uint64_t{seen.back()} + 1));
  for (const uint32_t primitive : seen) {
    const auto first = static_cast<uint32_t>(input.vertices.size());
    const auto x = static_cast<float>(3 * first);
    for (const Vertex& v : triangle_at(4).vertices) input.vertices.push_back({x + v.x, v.y, v.z});
    for (uint32_t k = 0; k < 3; ++k) input.indices[3 * uint64_t{primitive} + k] = first + k;
  }
  Harness h;
  h.use_standard_pipeline();
  const uint64_t scene = h.scene({input});
  for (size_t i = 0; i < seen.size(); ++i) {
    const Payload payload = h.trace(ray_along_z(scene, static_cast<float>(9 * i)));
    EXPECT_EQ(payload.end, End::kClosestHit);
    EXPECT_EQ(payload.values.primitive_index, seen[i]);
  }
}

TEST(Large, PrimitiveIndicesGoPast24Bits) {
  const uint32_t bits = std::getenv("KAAMOS_FULL") != nullptr ? 24 : 16;
  expect_indices(bits, kOpaque);
  expect_indices(bits, kNonOpaque);  // exact, in packs
}

}  // namespace
}  // namespace kaamos::embree::testing
