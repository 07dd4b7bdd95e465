// SPDX-License-Identifier: MIT
//
// Up to four triangles that lie close together: what Embree calls a primitive in exact precision.
// One call and one box for four of them, and a filter that looks at all four at once. Most packs
// that a ray comes to end there; exact_triangle.h decides about the triangles that are left.
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

// A bit for each triangle that the line of the ray may hit. The others intersect() refuses: of two
// of their edges the ray passes on different sides for certain. Differences of rounded products
// have the sign of the exact ones or are 0, so that this needs no bound of errors.
using PackFilter = uint32_t (*)(const ExactRay& ray, const TrianglePack& pack);
uint32_t filter_pack_sse2(const ExactRay& ray, const TrianglePack& pack);
uint32_t filter_pack_avx(const ExactRay& ray, const TrianglePack& pack);
// The fastest that this machine has. All give the same.
PackFilter fastest_pack_filter();

// A triangle to be packed; `bounds` as Embree's builder takes them.
struct PackInput {
  uint32_t primitive;
  float lower[3];
  float upper[3];
};

// Groups the triangles as leaves of a tree: `corner(primitive, k)` gives vertices, of 3 floats. The
// order is that of the tree. Empty where Embree failed; its error is kept at the device.
std::vector<TrianglePack> build_packs(RTCDevice device, const std::vector<PackInput>& inputs,
                                      RTCBuildQuality quality, const float* vertices,
                                      const uint32_t* indices);

}  // namespace kaamos::embree
