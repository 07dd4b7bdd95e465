// SPDX-License-Identifier: MIT
//
// Up to four triangles that are close together: what Embree calls a primitive in exact precision.
// Four triangles share one call and one box, and a filter tests all four at once. It rejects all
// four in most packs that a ray reaches; exact_triangle.h decides about the triangles that are
// left.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/embree/embree_shim.h"
#include "runtime/embree/exact_triangle.h"

namespace kaamos::embree {

inline constexpr uint32_t kPackSize = 4;

struct alignas(16) TrianglePack {
  float corners[3][3][kPackSize];  // vertex, axis, triangle
  uint32_t primitives[kPackSize];
  uint32_t count;

  void corner_of(uint32_t triangle, int k, float out[3]) const {
    for (int axis = 0; axis < 3; ++axis) out[axis] = corners[k][axis][triangle];
  }
};

// Returns a bit for each triangle that the line of the ray may hit. intersect() is certain to
// refuse the others: the ray passes two of their edges on different sides. Differences of rounded
// products have the sign of the exact ones or are 0, so no error bound is needed.
using PackFilter = uint32_t (*)(const ExactRay& ray, const TrianglePack& pack);
uint32_t filter_pack_sse2(const ExactRay& ray, const TrianglePack& pack);
uint32_t filter_pack_avx(const ExactRay& ray, const TrianglePack& pack);  // on x86-64 only
// The fastest filter that this machine can run. All give the same results.
PackFilter fastest_pack_filter();

// A triangle to be packed, with `bounds` as Embree's builder takes them.
struct PackInput {
  uint32_t primitive;
  float lower[3];
  float upper[3];
};

// Groups the triangles into packs, the leaves of a tree, in the tree's order. `vertices` have 3
// floats each. Empty if Embree failed; the device keeps the error.
std::vector<TrianglePack> build_packs(RTCDevice device, const std::vector<PackInput>& inputs,
                                      RTCBuildQuality quality, const float* vertices,
                                      const uint32_t* indices);

}  // namespace kaamos::embree
