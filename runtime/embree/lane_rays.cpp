// SPDX-License-Identifier: MIT
#include "runtime/embree/lane_rays.h"

#include <cstring>

#include "runtime/structures/instances.h"

namespace kaamos::embree {
namespace {

using Floats4 [[gnu::vector_size(16)]] = float;
using Floats8 [[gnu::vector_size(32)]] = float;

// Floats: a vector with as many lanes as a register has.
template <typename Floats>
[[gnu::always_inline]] inline void search_here(const shader::LaneRays& rays,
                                               const InstanceBoxes& boxes, LaneSearches& out) {
  using Bits = decltype(Floats{} < Floats{});
  using Words [[gnu::vector_size(sizeof(Floats))]] = uint32_t;
  constexpr int kStep = sizeof(Floats) / sizeof(float);
  const Bits sign_bit = Bits{} + INT32_MIN;
  const Floats smallest = Floats{} + FLT_MIN;
  out.valid = 0;
  for (int lane = 0; lane < shader::kLanes; lane += kStep) {
    Floats t_min;
    Floats t_max;
    std::memcpy(&t_min, rays.t_min + lane, sizeof(Floats));
    std::memcpy(&t_max, rays.t_max + lane, sizeof(Floats));
    Bits valid = (t_min <= t_max) & (t_min <= FLT_MAX);
    Floats origin[3];
    Floats slope[3];
#pragma GCC unroll 3
    for (int axis = 0; axis < 3; ++axis) {
      std::memcpy(&origin[axis], rays.origin[axis] + lane, sizeof(Floats));
      Floats direction;
      std::memcpy(&direction, rays.direction[axis] + lane, sizeof(Floats));
      const auto far = reinterpret_cast<Floats>(reinterpret_cast<Bits>(origin[axis]) & ~sign_bit);
      const auto size = reinterpret_cast<Floats>(reinterpret_cast<Bits>(direction) & ~sign_bit);
      valid &= (far <= runtime::kLargestCoordinate) & (size <= runtime::kLargestCoordinate);
      // As in InstanceBoxes::reciprocal.
      const Floats over = 1.0f / (size > smallest ? size : smallest);
      slope[axis] = reinterpret_cast<Floats>(reinterpret_cast<Bits>(over) |
                                             (reinterpret_cast<Bits>(direction) & sign_bit));
    }
    t_min = t_min > 0 ? t_min : Floats{};
    const auto above = reinterpret_cast<Bits>(reinterpret_cast<Words>(t_min) + 1);
    const auto below = reinterpret_cast<Bits>(reinterpret_cast<Words>(t_max) - 1);
    const Bits t_near = t_min < smallest ? reinterpret_cast<Bits>(smallest) : above;
    const Bits t_far = t_max <= smallest ? Bits{} : below;
    std::memcpy(out.t_near + lane, &t_near, sizeof(Bits));
    std::memcpy(out.t_far + lane, &t_far, sizeof(Bits));

    Bits entered = {};
    Words bit = Words{} + 1;
    float* entry = out.entry[0] + lane;
    for (const InstanceBoxes::Box& box : boxes.boxes()) {
      Floats in = t_min;
      Floats leave = t_max;
#pragma GCC unroll 3
      for (int axis = 0; axis < 3; ++axis) {
        const Floats lower = (box.sides[axis][0] - origin[axis]) * slope[axis];
        const Floats upper = (box.sides[axis][1] - origin[axis]) * slope[axis];
        const Floats near = lower < upper ? lower : upper;
        const Floats far = lower > upper ? lower : upper;
        in = in > near ? in : near;
        leave = leave < far ? leave : far;
      }
      in *= InstanceBoxes::kSooner;
      leave *= InstanceBoxes::kLater;
      std::memcpy(entry, &in, sizeof(Floats));
      entry += shader::kLanes;
      entered |= (in <= leave) & reinterpret_cast<Bits>(bit);
      bit += bit;
    }
    entered &= static_cast<int32_t>(boxes.all());
    std::memcpy(out.entered + lane, &entered, sizeof(Bits));
    for (int i = 0; i < kStep; ++i) out.valid |= static_cast<uint32_t>(valid[i] & 1) << (lane + i);
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void search_by_avx2(const shader::LaneRays& rays,
                                            const InstanceBoxes& boxes, LaneSearches& out) {
  search_here<Floats8>(rays, boxes, out);
}
#endif

}  // namespace

void search_lanes(const shader::LaneRays& rays, const InstanceBoxes& boxes, LaneSearches& out,
                  [[maybe_unused]] shader::CpuLevel level) {
#if defined(__x86_64__)
  if (level == shader::CpuLevel::kAvx2) return search_by_avx2(rays, boxes, out);
#endif
  search_here<Floats4>(rays, boxes, out);
}

}  // namespace kaamos::embree
