// SPDX-License-Identifier: MIT
//
// Tests what exact precision promises: no wrong hit, hit data rounded once, the same on every
// processor; and robust precision where any-hit shaders see every triangle: no wrong hit.
// `kaamos-bench --precision-table` is the long form, with every precision and both backends.
#include "exactness.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstring>

#include "size.h"

namespace kaamos::test {
namespace {

rtapi::DeviceDesc with(rtapi::TraversalPrecision precision) {
  rtapi::DeviceDesc desc;
  desc.Precision = precision;
  return desc;
}

TEST(Exactness, NoHitIsWrongAtAnyScaleAndDistance) {
  const std::uint32_t rays = by_size(300, 3000, 300000);
  for (const auto precision :
       {rtapi::TraversalPrecision::kExact, rtapi::TraversalPrecision::kRobust}) {
    RayProbe probe(with(precision));
    for (const Placement& place : all_placements()) {
      for (const Aim aim : kAims) {
        EXPECT_EQ(count_wrong_hits(probe, place, aim, rays).wrong, 0u)
            << name_of(place) << " aim " << static_cast<int>(aim) << " precision "
            << static_cast<int>(precision);
      }
    }
  }
}

// Otherwise the test above would prove little.
TEST(Exactness, TheSameRaysFindWhatIsWrongInFast) {
  RayProbe fast(with(rtapi::TraversalPrecision::kFast));
  EXPECT_GT(count_wrong_hits(fast, {1, 0, 0}, Aim::kEdge, 1000).wrong, 100u);
  EXPECT_GT(count_wrong_hits(fast, {1, 0, 0}, Aim::kVertex, 1000).wrong, 100u);
}

TEST(Exactness, HitDataIsRoundedOnce) {
  RayProbe exact(with(rtapi::TraversalPrecision::kExact));
  for (const Placement& place : all_placements()) {
    const HitErrors errors = measure_hit_errors(exact, place, by_size(300, 3000, 300000));
    EXPECT_LE(errors.t, 0.51) << name_of(place);
    EXPECT_LE(errors.barycentrics, 0.51) << name_of(place);
  }
}

// Sets an environment variable for the lifetime of the object.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~Environment() { unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
};

TEST(Exactness, HitsDoNotDependOnTheInstructionSet) {
  std::vector<const char*> sets = {"isa=sse2", "isa=sse4.2"};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx")) sets.push_back("isa=avx");
  if (__builtin_cpu_supports("avx2")) sets.push_back("isa=avx2");
#endif
  for (const Placement& place :
       {Placement{1, 0, 0}, Placement{1e-9f, 0, 0}, Placement{1, 1e4f, 0}, Placement{1, 0, 1e4f},
        Placement{1, 1e6f, 10}, Placement{1e12f, 0, 10}}) {
    const std::vector<ProbeRay> rays = mixed_rays(place, by_size(300, 3000, 100000));
    std::vector<ProbeHit> first;
    for (const char* set : sets) {
      const Environment isa("KAAMOS_EMBREE_CONFIG", set);
      RayProbe exact(with(rtapi::TraversalPrecision::kExact));
      exact.set_mesh(mesh_of(place));
      const std::vector<ProbeHit> hits = exact.hits(rays);
      if (first.empty()) first = hits;
      EXPECT_EQ(std::memcmp(hits.data(), first.data(), hits.size() * sizeof(ProbeHit)), 0)
          << set << " " << name_of(place);
    }
  }
}

}  // namespace
}  // namespace kaamos::test
