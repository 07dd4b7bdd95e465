// SPDX-License-Identifier: MIT
//
// When any-hit shaders run and what they may do; what a trace does for its caller.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "tests/conformance/compile.h"
#include "tests/conformance/walker.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr auto kOnce = RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

const char* const kRayStages[] = {"raygeneration", "intersection", "anyhit",
                                  "closesthit",    "miss",         "callable"};

// Every combination of inside the extents, not culled, not opaque, and an any-hit shader in the
// group.
void any_hit_truth_table(Context& t) {
  Standard program(t);
  program.record("Counted");
  program.record("Plain");
  program.scene = t.top_level({instance(t.bottom_level({triangle(5, 0, kOnce)})),
                               instance(t.bottom_level({triangle(5, 0, kOnce)}), 10, 1)});
  std::vector<Ray> rays;
  std::vector<uint32_t> expected, found;
  for (uint32_t bits = 0; bits < 16; ++bits) {
    const bool outside = (bits & 1) != 0, culled = (bits & 2) != 0, opaque = (bits & 4) != 0,
               none = (bits & 8) != 0;
    Ray ray = ray_at(none ? 10 : 0);
    ray.t_max = outside ? 4 : 6;
    ray.flags = (culled ? 0x20u : 0) | (opaque ? 0x1u : 0);
    rays.push_back(ray);
    expected.push_back(outside || culled || opaque || none ? 0 : 1);
  }
  const auto seen = program.trace(rays);
  for (uint32_t bits = 0; bits < 16; ++bits) {
    found.push_back(seen[bits].any_hits);
    t.equal("end of case " + std::to_string(bits), seen[bits].end,
            (bits & 3) != 0 ? kMissRan : kClosestHitRan);
  }
  t.equal("any-hit shaders", found, expected);
}

void payload_outlives_ignored_and_ended(Context& t) {
  Standard program(t);
  program.record("Ignored");
  const Seen seen = program.trace(t.scene({triangle(5, 0, kOnce), triangle(7, 0, kOnce)}));
  t.equal("writes before IgnoreHit()", seen.any_hits, 2u);
  t.equal("end", seen.end, kMissRan);
}

void any_hit_shaders_may_query(Context& t) {
  for (const char* call : {"TraceRay(scene, 0, 0xFF, 0, 0, 0, ray, p);", "CallShader(0, p);"}) {
    t.refused(std::string(call) + " in an any-hit shader", compile(shader_of("anyhit", call)));
  }
  Walker walker(t);
  walker.record("ShadowedTriangle");
  // Five triangles at z = 1 ... 5; a wall at x = 8 from z = 2.5 on shadows three of them.
  std::vector<Geometry> sheets;
  for (int i = 1; i <= 5; ++i) sheets.push_back(triangle(static_cast<float>(i), 0, kOnce));
  Geometry wall;
  wall.vertices = {8, -9, 2.5f, 8, 9, 2.5f, 8, 0.2f, 90};
  RaytracingInstanceDesc lit = instance(t.bottom_level(sheets));
  RaytracingInstanceDesc hiding = instance(t.bottom_level({wall}));
  lit.InstanceMask = 1;
  hiding.InstanceMask = 2;
  walker.scene = t.top_level({lit, hiding});
  Ray ray;
  ray.mask = 1;
  const auto walked = walker.walk({ray});
  t.distance("t of the nearest that is accepted", walked[0].seen.t, 3.0f);
  t.holds("the lit ones were asked", walked[0].seen.any_hits >= 3);
  t.equal("values of the candidate changed by the query", walker.faults(), 0u);
}

void callees_complete_first(Context& t) {
  Walker walker(t);
  walker.record("Plain");
  walker.callable("AddTen");
  walker.raygen("Straight");
  walker.scene = t.scene({triangle(5)});
  walker.prepare({Ray{}});
  const auto words = walker.run();
  t.equal("closest-hit shaders of four traces with one payload", words[0], 4u);
  t.equal("the copy made before", words[1], 0u);
  t.equal("a local of the caller", words[2], ((((5u * 3 + 1) * 3 + 2) * 3 + 3) * 3 + 4));
  t.equal("parameters of calls", words[3], 21u);
  t.equal("other parameters of calls", words[4], 1020u);
}

void coherent_writes_are_seen(Context& t) {
  Walker walker(t);
  walker.record("Board");
  walker.raygen("WriteBoard");
  walker.scene = t.scene({triangle(5)});
  walker.prepare({Ray{}});
  const Buffer board = t.zeros(16 * 64);
  walker.bind = [board](CommandList& list) {
    list.SetComputeRootUnorderedAccessView(5, board.GetGPUVirtualAddress());
  };
  const auto words = walker.run(64);
  for (uint32_t i = 0; i < 64; ++i) {
    t.equal("the caller's word in the closest-hit shader", words[2 * i], 41 + 16 * i);
    t.equal("the closest-hit shader's word in the caller", words[2 * i + 1], 77 + 16 * i);
  }
}

void no_derivatives_no_group_sync(Context& t) {
  for (const char* stage : kRayStages) {
    for (const char* statement :
         {"float d = ddx(ray.TMin); words.Store(0, asuint(d));",
          "float d = ddy_fine(ray.TMin); words.Store(0, asuint(d));",
          "float d = fwidth(ray.TMin); words.Store(0, asuint(d));",
          "GroupMemoryBarrierWithGroupSync();", "AllMemoryBarrierWithGroupSync();",
          "DeviceMemoryBarrierWithGroupSync();", "GroupMemoryBarrier();"}) {
      t.refused(std::string(statement) + " in " + stage, compile(shader_of(stage, statement)));
    }
    t.accepted(std::string("DeviceMemoryBarrier() in ") + stage,
               compile(shader_of(stage, "DeviceMemoryBarrier();")));
  }
}

// Tests what holds for waves of any size; here each thread is a wave.
void waves(Context& t) {
  Walker walker(t);
  walker.record("WavesOfHit");
  walker.raygen("Waves");
  walker.scene = t.scene({triangle(5)});
  walker.prepare({Ray{}});
  const auto words = walker.run(37);
  for (uint32_t i = 0; i < 37; ++i) {
    t.equal("what does not hold in thread " + std::to_string(i), words[2 * i], 0u);
    t.holds("the count of lanes is one of DXR's", words[2 * i + 1] >= 1 && words[2 * i + 1] <= 128);
  }
  for (const char* stage : kRayStages) {
    t.accepted(std::string("WaveActiveSum() in ") + stage,
               compile(shader_of(stage, "words.Store(0, WaveActiveSum(7u));")));
  }
}

// Tests what normal mode does with rays that DXR leaves undefined: nothing is hit, nothing hangs.
void odd_rays(Context& t) {
  Standard program(t);
  program.record("Plain");
  program.record("Box", 5);
  program.scene = t.top_level(
      {instance(t.bottom_level({triangle(5)})), instance(t.bottom_level({box(5)}), 10, 1)});
  const auto make = [](float x, float t_min, float t_max) {
    Ray ray = ray_at(x);
    ray.t_min = t_min;
    ray.t_max = t_max;
    return ray;
  };
  const auto legal = program.trace({make(0, 5, 5), make(10, 5, 5), make(0, kInfinity, kInfinity),
                                    make(10, kInfinity, kInfinity), make(0, 0, kInfinity)});
  t.equal("end of a triangle, TMin = TMax = t", legal[0].end, kMissRan);
  t.equal("end of a box, TMin = TMax = t", legal[1].end, kClosestHitRan);
  t.equal("end of a triangle, both infinite", legal[2].end, kMissRan);
  t.equal("end of a box, both infinite", legal[3].end, kMissRan);
  t.equal("end of a triangle, TMax infinite", legal[4].end, kClosestHitRan);
  std::vector<Ray> rays = {make(0, 7, 3), make(0, kNan, 100), make(0, 0, kNan), make(10, 7, 3)};
  for (size_t i = 0; i < 3; ++i) {
    for (const float value : {kNan, kInfinity}) {
      rays.emplace_back();
      rays.back().origin[i] = value;
      rays.emplace_back();
      rays.back().direction[i] = value;
    }
  }
  size_t i = 0;
  for (const Seen& each : program.trace(rays)) {
    t.equal("end of undefined ray " + std::to_string(i++), each.end, kMissRan);
  }
}

void rays_without_direction(Context& t) {
  Standard program(t);
  program.record("Plain");
  program.record("Box", 0);
  program.scene = t.top_level(
      {instance(t.bottom_level({triangle(5)})), instance(t.bottom_level({box(5)}), 10, 1)});
  Ray on_triangle, in_box = ray_at(10), outside = ray_at(30);
  on_triangle.origin[2] = in_box.origin[2] = 5;
  std::vector<Ray> rays = {on_triangle, Ray{}, in_box, outside};
  for (Ray& each : rays) each.direction[2] = 0;
  const auto seen = program.trace(rays);
  t.equal("end on a triangle", seen[0].end, kMissRan);
  t.equal("end before a triangle", seen[1].end, kMissRan);
  t.holds("one of the shaders ran in a box", seen[2].end != kNothingRan);
  t.equal("end away from everything", seen[3].end, kMissRan);
}

// Long crossing triangles, which builders like to split; each must be reported once.
void long_triangles_show_once(Context& t) {
  Walker walker(t);
  walker.record("Ignored");
  Random random(21);
  Geometry needles;
  needles.flags = kOnce;
  for (int i = 0; i < 400; ++i) {
    const float x = random.between(-60, 60), y = random.between(-60, 60);
    const float z = random.between(2, 60);
    for (const float value : {x, y, z, -x, -y, z + random.between(0, 20), -x + 0.7f, -y + 0.5f,
                              z + random.between(0, 20)}) {
      needles.vertices.push_back(value);
    }
  }
  Scene scene;
  scene.bottom_levels = {{needles}};
  scene.instances.emplace_back();
  scene.instances[0].AccelerationStructure = 0;
  scene.records = {GroupKind::kAnyHit};
  const RaytracingInstanceDesc desc = instance(t.bottom_level({needles}));
  std::copy(&desc.Transform[0][0], &desc.Transform[0][0] + 12, &scene.instances[0].Transform[0][0]);
  scene.instances[0].InstanceMask = desc.InstanceMask;
  walker.scene = t.top_level({desc});
  std::vector<Ray> rays;
  for (int i = 0; i < 3000; ++i) {
    rays.push_back(ray_at(random.between(-8, 8), random.between(-8, 8)));
    rays.back().direction[0] = random.between(-0.2f, 0.2f);
  }
  const auto counts = walker.count(rays);
  uint32_t wrong = 0, crossed = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    const auto all = candidates(scene, rays[i]);
    uint32_t certain = 0;
    for (const Candidate& each : all) certain += each.certain ? 1 : 0;
    wrong += counts[i] >= certain && counts[i] <= all.size() ? 0 : 1;
    crossed += certain;
  }
  t.equal("rays of 3000 with a wrong number of any-hit shaders", wrong, 0u);
  t.holds("thousands of triangles were crossed", crossed > 3000);
}

}  // namespace

std::vector<RuleTest> trv_any_hit_tests() {
  return {{"TRV-09", odd_rays, "KA0401, KA0402"},
          {"TRV-10", rays_without_direction},
          {"TRV-20", any_hit_truth_table},
          {"TRV-24", payload_outlives_ignored_and_ended},
          {"TRV-27", any_hit_shaders_may_query},
          {"TRV-31", long_triangles_show_once},
          {"TRV-47", callees_complete_first},
          {"TRV-48", coherent_writes_are_seen},
          {"TRV-49", waves},
          {"TRV-50", no_derivatives_no_group_sync}};
}

}  // namespace kaamos::conformance
