// SPDX-License-Identifier: MIT
//
// The filter of exact_pack.h, written with `Lanes`, four doubles, which exact_pack_sse2.cpp and
// exact_pack_avx.cpp define. Those two are compiled for different processors, so everything here is
// local to the file, and nothing calls inline functions of other headers.
#pragma once

namespace kaamos::embree {
namespace {

struct LanesOfVertex {
  Lanes x, y;
};

// The same operations as project() of exact_triangle.h, in the same order.
inline LanesOfVertex project_lanes(const ExactRay& ray, const float corner[3][kPackSize]) {
  const Lanes z = Lanes::load(corner[ray.z]) - Lanes::all(ray.origin[ray.z]);
  return {Lanes::load(corner[ray.x]) - Lanes::all(ray.origin[ray.x]) - Lanes::all(ray.shear_x) * z,
          Lanes::load(corner[ray.y]) - Lanes::all(ray.origin[ray.y]) - Lanes::all(ray.shear_y) * z};
}

inline uint32_t filter_pack(const ExactRay& ray, const TrianglePack& pack) {
  const LanesOfVertex a = project_lanes(ray, pack.corners[0]);
  const LanesOfVertex b = project_lanes(ray, pack.corners[1]);
  const LanesOfVertex c = project_lanes(ray, pack.corners[2]);
  const Lanes ab = a.x * b.y, ba = a.y * b.x;
  const Lanes bc = b.x * c.y, cb = b.y * c.x;
  const Lanes ca = c.x * a.y, ac = c.y * a.x;
  const uint32_t left = bits_of(above(ab, ba) | above(bc, cb) | above(ca, ac));
  const uint32_t right = bits_of(above(ba, ab) | above(cb, bc) | above(ac, ca));
  return ~(left & right) & ((1u << pack.count) - 1);
}

}  // namespace
}  // namespace kaamos::embree
