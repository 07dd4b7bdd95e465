// SPDX-License-Identifier: MIT
//
// Flags, opacity, culling, masks.
#include <shaders/nested.h>

#include <cmath>

#include "tests/conformance/program.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr auto kOpaque = RaytracingGeometryFlags::kOpaque;
constexpr auto kNonOpaque = RaytracingGeometryFlags::kNone;
// Ray flags.
constexpr uint32_t kForceOpaque = 0x1, kForceNonOpaque = 0x2, kAcceptFirst = 0x4,
                   kSkipClosest = 0x8, kCullBack = 0x10, kCullFront = 0x20, kCullOpaque = 0x40,
                   kCullNonOpaque = 0x80, kSkipTriangles = 0x100, kSkipProcedural = 0x200;
// Instance flags.
constexpr uint32_t kCullDisable = 1, kFrontCounterclockwise = 2, kInstanceOpaque = 4,
                   kInstanceNonOpaque = 8;

Ray with_flags(uint32_t flags, float x = 0) {
  Ray ray = ray_at(x);
  ray.flags = flags;
  return ray;
}

void flags_are_echoed(Context& t) {
  Standard program(t);
  program.scene = t.scene({triangle(5)});
  program.records("Plain", 1);
  std::vector<Ray> rays;
  const uint32_t flags[] = {0,    0x1,  0x2,  0x4,   0x8,   0x10,  0x20,
                            0x40, 0x80, 0x1D, 0x100, 0x200, 0x20C, 0x22E};
  for (const uint32_t each : flags) rays.push_back(with_flags(each, 100));
  rays.push_back(with_flags(kForceOpaque | kAcceptFirst | kCullBack));
  const auto seen = program.trace(rays);
  for (size_t i = 0; i < std::size(flags); ++i) {
    t.equal("RayFlags() in the miss shader", seen[i].flags, flags[i]);
  }
  t.equal("RayFlags() in the closest-hit shader", seen.back().flags, 0x15u);
}

// Two geometry flags x three instance flags x three ray flags: how many any-hit shaders ran (0 or
// 1) against how many should have.
void opacity_matrix(Context& t, const std::string& group, Geometry (*make)(RaytracingGeometryFlags),
                    uint32_t ray_kinds, uint32_t instance_kinds) {
  Standard program(t);
  program.record(group);
  const uint32_t instance_flags[] = {0, kInstanceOpaque, kInstanceNonOpaque};
  const uint32_t ray_flags[] = {0, kForceOpaque, kForceNonOpaque};
  std::vector<RaytracingInstanceDesc> instances;
  std::vector<Ray> rays;
  std::vector<uint32_t> expected;
  for (uint32_t opaque = 0; opaque < 2; ++opaque) {
    const Buffer geometry = t.bottom_level({make(opaque == 1 ? kOpaque : kNonOpaque)});
    for (uint32_t i = 0; i < instance_kinds; ++i) {
      const float x = 10.0f * static_cast<float>(instances.size());
      instances.push_back(instance(geometry, x, 0, instance_flags[i]));
      for (uint32_t r = 0; r < ray_kinds; ++r) {
        rays.push_back(with_flags(ray_flags[r], x));
        const bool is_opaque = r != 0 ? r == 1 : i != 0 ? i == 1 : opaque == 1;
        expected.push_back(is_opaque ? 0 : 1);
      }
    }
  }
  program.scene = t.top_level(instances);
  std::vector<uint32_t> found;
  for (const Seen& each : program.trace(rays)) {
    found.push_back(each.any_hits > 0 ? 1 : 0);
    t.equal("end", each.end, kClosestHitRan);
  }
  t.equal(group + ": whether any-hit shaders ran", found, expected);
}

Geometry make_triangle(RaytracingGeometryFlags flags) {
  return triangle(5, 0, flags);
}

Geometry make_box(RaytracingGeometryFlags flags) {
  return box(5, 0, flags);
}

void geometry_flag_is_the_base(Context& t) {
  opacity_matrix(t, "Counted", make_triangle, 1, 1);
}

void instance_flags_replace_it(Context& t) {
  opacity_matrix(t, "Counted", make_triangle, 1, 3);
}

void ray_flags_replace_both(Context& t) {
  opacity_matrix(t, "Counted", make_triangle, 3, 3);
}

void opacity_of_boxes(Context& t) {
  opacity_matrix(t, "BoxCounted", make_box, 3, 3);
}

void no_any_hit_shader_commits(Context& t) {
  Standard program(t);
  program.record("Plain");
  program.record("");
  program.scene = t.top_level({instance(t.bottom_level({triangle(5, 0, kNonOpaque)})),
                               instance(t.bottom_level({triangle(5, 0, kNonOpaque)}), 10, 1)});
  const auto seen = program.trace({with_flags(kForceNonOpaque), with_flags(kForceNonOpaque, 10)});
  t.equal("end with a closest-hit shader only", seen[0].end, kClosestHitRan);
  t.equal("end with a NULL group", seen[1].end, kNothingRan);
}

void culling_looks_at_flags_only(Context& t) {
  Standard program(t);
  program.record("Plain");
  program.scene = t.scene({triangle(5, 0, kNonOpaque)});
  t.equal("end of CULL_OPAQUE", program.trace(with_flags(kCullOpaque)).end, kClosestHitRan);
  t.equal("end of CULL_NON_OPAQUE", program.trace(with_flags(kCullNonOpaque)).end, kMissRan);
}

void opacity_culling_of_all_primitives(Context& t) {
  Standard program(t);
  program.record("BoxCounted");
  program.record("Counted");
  for (const uint32_t opaque : {0u, 1u}) {
    const auto flags = opaque == 1 ? kOpaque : kNonOpaque;
    const uint32_t cull = opaque == 1 ? kCullOpaque : kCullNonOpaque;
    const uint32_t keep = opaque == 1 ? kCullNonOpaque : kCullOpaque;
    program.scene = t.top_level({instance(t.bottom_level({make_box(flags)})),
                                 instance(t.bottom_level({make_triangle(flags)}), 10, 1)});
    auto seen = program.trace({with_flags(cull), with_flags(cull, 10)});
    t.equal("end of a culled box", seen[0].end, kMissRan);
    t.equal("intersection shaders of a culled box", program.intersections(), 0u);
    t.equal("end of a culled triangle", seen[1].end, kMissRan);
    t.equal("any-hit shaders of a culled triangle", seen[1].any_hits, 0u);
    seen = program.trace({with_flags(keep), with_flags(keep, 10)});
    t.equal("end of the other box", seen[0].end, kClosestHitRan);
    t.equal("end of the other triangle", seen[1].end, kClosestHitRan);
  }
}

// The rule's triangle at z = 0, and a ray from z = -1.
Seen facing(Context& t, uint32_t instance_flags, uint32_t ray_flags, float instance_scale_x = 1,
            float geometry_scale_x = 1) {
  Standard program(t);
  program.record("Plain");
  Geometry geometry;
  geometry.vertices = {0, 1, 0, 1, 0, 0, -1, 0, 0};
  if (geometry_scale_x != 1)
    geometry.transform = {geometry_scale_x, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  RaytracingInstanceDesc desc = instance(t.bottom_level({geometry}), 0, 0, instance_flags);
  desc.Transform[0][0] = instance_scale_x;
  Ray ray = with_flags(ray_flags);
  ray.origin[2] = -1;
  return program.trace(t.top_level({desc}), ray);
}

void clockwise_is_front(Context& t) {
  t.equal("HitKind()", facing(t, 0, 0).hit_kind, 254u);
}

void front_counterclockwise_swaps(Context& t) {
  t.equal("HitKind()", facing(t, kFrontCounterclockwise, 0).hit_kind, 255u);
  t.equal("end with CULL_BACK", facing(t, kFrontCounterclockwise, kCullBack).end, kMissRan);
  t.equal("end with CULL_FRONT", facing(t, kFrontCounterclockwise, kCullFront).end, kClosestHitRan);
}

void mirrored_instance_keeps_facing(Context& t) {
  t.equal("HitKind()", facing(t, 0, 0, -1).hit_kind, 254u);
  t.equal("end with CULL_FRONT", facing(t, 0, kCullFront, -1).end, kMissRan);
}

void mirrored_geometry_flips_facing(Context& t) {
  t.equal("HitKind()", facing(t, 0, 0, 1, -1).hit_kind, 255u);
  t.equal("end with CULL_BACK", facing(t, 0, kCullBack, 1, -1).end, kMissRan);
}

void face_culling_comes_first(Context& t) {
  Standard program(t);
  program.record("Counted");
  program.record("Box");
  program.scene = t.top_level({instance(t.bottom_level({triangle(5, 0, kNonOpaque)})),
                               instance(t.bottom_level({box(5)}), 10, 1)});
  const auto seen = program.trace({with_flags(kCullFront), with_flags(kCullBack),
                                   with_flags(kCullFront, 10), with_flags(kCullBack, 10)});
  t.equal("end of a front face, CULL_FRONT", seen[0].end, kMissRan);
  t.equal("its any-hit shaders", seen[0].any_hits, 0u);
  t.equal("end of a front face, CULL_BACK", seen[1].end, kClosestHitRan);
  t.equal("end of a box, CULL_FRONT", seen[2].end, kClosestHitRan);
  t.equal("end of a box, CULL_BACK", seen[3].end, kClosestHitRan);
}

void cull_disable_undoes_face_culling_only(Context& t) {
  Standard program(t);
  program.record("Plain");
  program.scene = t.scene({triangle(5)}, 0, kCullDisable);
  const auto seen = program.trace({with_flags(kCullFront), with_flags(kCullBack),
                                   with_flags(kSkipTriangles), with_flags(kCullOpaque)});
  t.equal("end of CULL_FRONT", seen[0].end, kClosestHitRan);
  t.equal("end of CULL_BACK", seen[1].end, kClosestHitRan);
  t.equal("end of SKIP_TRIANGLES", seen[2].end, kMissRan);
  t.equal("end of CULL_OPAQUE", seen[3].end, kMissRan);
}

Buffer triangle_before_box(Context& t) {
  return t.top_level(
      {instance(t.bottom_level({triangle(5)})), instance(t.bottom_level({box(10)}), 0, 1)});
}

void skip_flags_drop_a_class(Context& t) {
  Standard program(t);
  program.record("Plain");
  program.record("Box", 10);
  program.scene = triangle_before_box(t);
  const auto seen =
      program.trace({with_flags(0), with_flags(kSkipTriangles), with_flags(kSkipProcedural)});
  t.equal("record without flags", seen[0].record, 0u);
  t.equal("record of SKIP_TRIANGLES", seen[1].record, 1u);
  t.equal("record of SKIP_PROCEDURAL_PRIMITIVES", seen[2].record, 0u);
  program.trace(with_flags(kSkipProcedural));
  t.equal("intersection shaders", program.intersections(), 0u);
}

void pipeline_flags_skip_and_do_not_show(Context& t) {
  for (const auto flags : {RaytracingPipelineFlags::kSkipTriangles,
                           RaytracingPipelineFlags::kSkipProceduralPrimitives}) {
    const bool triangles = flags == RaytracingPipelineFlags::kSkipTriangles;
    Standard program(t);
    program.set_pipeline_flags(flags);
    program.record("Plain");
    program.record("Box", 10);
    const Seen seen = program.trace(triangle_before_box(t));
    t.equal("record", seen.record, triangles ? 1u : 0u);
    t.equal("RayFlags()", seen.flags, 0u);
    if (!triangles) t.equal("intersection shaders", program.intersections(), 0u);
  }
}

void masks_meet_bit_by_bit(Context& t) {
  Standard program(t);
  program.record("Plain");
  const Buffer geometry = t.bottom_level({triangle(5)});
  std::vector<RaytracingInstanceDesc> instances;
  std::vector<Ray> rays;
  std::vector<uint32_t> found, expected;
  for (uint32_t i = 0; i < 8; ++i) {
    const float x = 10.0f * static_cast<float>(i);
    instances.push_back(instance(geometry, x));
    instances.back().InstanceMask = 1u << i;
    for (uint32_t mask : {0x01u, 0x02u, 0x04u, 0x08u, 0x10u, 0x20u, 0x40u, 0x80u, 0xFFu, 0u, 0x100u,
                          0xFFFFFF00u, 0x1FFu}) {
      rays.push_back(ray_at(x));
      rays.back().mask = mask;
      expected.push_back((mask & (1u << i)) != 0 ? kClosestHitRan : kMissRan);
    }
  }
  program.scene = t.top_level(instances);
  for (const Seen& each : program.trace(rays)) found.push_back(each.end);
  t.equal("ends", found, expected);
}

void mask_zero_hides(Context& t) {
  Standard program(t);
  program.record("Plain");
  RaytracingInstanceDesc desc = instance(t.bottom_level({triangle(5)}));
  desc.InstanceMask = 0;
  t.equal("end", program.trace(t.top_level({desc})).end, kMissRan);
}

void first_hit_ends_the_search(Context& t) {
  Standard program(t);
  program.records("Plain", 2);
  program.scene = t.scene({triangle(5), triangle(10)});
  Ray ray = with_flags(kAcceptFirst);
  ray.multiplier = 1;
  const Seen seen = program.trace(ray);
  t.equal("closest-hit shaders", seen.closest_hits, 1u);
  t.distance("t of the geometry hit", seen.t, seen.geometry == 0 ? 5.0f : 10.0f);
}

void ignored_hits_do_not_end_it(Context& t) {
  Standard program(t);
  program.record("Ignored");
  program.record("Plain");
  Ray ray = with_flags(kAcceptFirst);
  ray.multiplier = 1;
  program.scene = t.scene({triangle(5, 0, kNonOpaque), triangle(10)});
  t.equal("record behind an ignored hit", program.trace(ray).record, 1u);
  program.scene = t.scene({triangle(5, 0, kOpaque)});
  const Seen seen = program.trace(ray);
  t.equal("end where opacity skips the any-hit shader", seen.end, kClosestHitRan);
  t.equal("its any-hit shaders", seen.any_hits, 0u);
}

void closest_hit_runs_unless_skipped(Context& t) {
  Standard program(t);
  program.record("Plain");
  program.scene = t.scene({triangle(5)});
  const auto seen =
      program.trace({with_flags(0), with_flags(kAcceptFirst), with_flags(kSkipClosest),
                     with_flags(kAcceptFirst | kSkipClosest)});
  t.equal("ends", std::vector<uint32_t>{seen[0].end, seen[1].end, seen[2].end, seen[3].end},
          {kClosestHitRan, kClosestHitRan, kNothingRan, kNothingRan});
}

void skipped_closest_hit_is_no_miss(Context& t) {
  Standard program(t);
  program.record("Counted");
  program.scene = t.scene({triangle(5, 0, kNonOpaque)});
  const auto seen = program.trace({with_flags(kSkipClosest), with_flags(kSkipClosest, 100)});
  t.equal("end of a hit", seen[0].end, kNothingRan);
  t.holds("any-hit shaders ran", seen[0].any_hits >= 1);
  t.equal("end of a miss", seen[1].end, kMissRan);
}

void flags_belong_to_one_trace(Context& t) {
  Standard program(t, kaamos_shaders_nested(), {"NestedFlags"});
  program.group("Nested", "NestedFlags");
  program.local(kRecordSignature, {"Nested"});
  program.record("Nested");
  program.record("Plain");
  program.scene = t.scene({triangle(5), triangle(10)});
  const Seen seen = program.trace(with_flags(kAcceptFirst | kForceOpaque));
  // Either triangle may be hit first; if it is the far one, the inner ray misses.
  t.equal("RayFlags() before the nested trace", seen.flags, 0x5u);
  t.equal("RayFlags() of the nested trace", seen.any_record, 0x11u);
  t.equal("RayFlags() after the nested trace", seen.geometry, 0x5u);
}

void geometry_flags_on_boxes(Context& t) {
  Standard program(t);
  program.record("BoxIgnored");
  Seen seen =
      program.trace(t.scene({box(5, 0, RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation)}));
  t.equal("any-hit shaders with NO_DUPLICATE", seen.any_hits, 1u);
  t.equal("end", seen.end, kMissRan);
  seen = program.trace(t.scene({box(5, 0, kOpaque)}));
  t.equal("any-hit shaders with OPAQUE", seen.any_hits, 0u);
  t.equal("end with OPAQUE", seen.end, kClosestHitRan);
}

}  // namespace

std::vector<RuleTest> flg_tests() {
  return {{"FLG-01", flags_are_echoed},
          {"FLG-10", geometry_flag_is_the_base},
          {"FLG-11", instance_flags_replace_it},
          {"FLG-12", ray_flags_replace_both},
          {"FLG-13", no_any_hit_shader_commits},
          {"FLG-14", opacity_of_boxes},
          {"FLG-15", culling_looks_at_flags_only},
          {"FLG-16", opacity_culling_of_all_primitives},
          {"FLG-20", clockwise_is_front},
          {"FLG-21", front_counterclockwise_swaps},
          {"FLG-22", mirrored_instance_keeps_facing},
          {"FLG-23", mirrored_geometry_flips_facing},
          {"FLG-24", face_culling_comes_first},
          {"FLG-25", cull_disable_undoes_face_culling_only},
          {"FLG-26", skip_flags_drop_a_class},
          {"FLG-27, SV-06", pipeline_flags_skip_and_do_not_show},
          {"FLG-30", masks_meet_bit_by_bit},
          {"FLG-31", mask_zero_hides},
          {"FLG-32", first_hit_ends_the_search},
          {"FLG-33", ignored_hits_do_not_end_it},
          {"FLG-34", closest_hit_runs_unless_skipped},
          {"FLG-35", skipped_closest_hit_is_no_miss},
          {"FLG-36", flags_belong_to_one_trace},
          {"FLG-37", geometry_flags_on_boxes}};
}

}  // namespace kaamos::conformance
