// SPDX-License-Identifier: MIT
//
// Ray, instance and geometry flags, opacity, facing and masks: rules FLG-nn.
#include <gtest/gtest.h>

#include "runtime/embree/ray_state.h"
#include "runtime/embree/testing/harness.h"

namespace kaamos::embree::testing {
namespace {

Payload trace_flags(Harness& h, uint64_t scene, uint32_t flags) {
  auto ray = ray_along_z(scene);
  ray.ray_flags = flags;
  return h.trace(ray);
}

GeometryInput transformed(GeometryInput input, std::vector<float> matrix) {
  input.transform = std::move(matrix);
  return input;
}
const std::vector<float> kMirror = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

TEST(Flg01, UndefinedBitsDoNotReachTheShader) {
  Harness h;
  h.use_standard_pipeline();
  EXPECT_EQ(trace_flags(h, 0, 0xFFFFF3FF).values.ray_flags, 0x3FFu);
}

TEST(Flg12, OpacityIsGeometryThenInstanceThenRay) {
  Harness h;
  h.use_standard_pipeline(any_hit_accept);
  for (const auto geometry : {kNonOpaque, kOpaque}) {
    for (const uint32_t instance : {0u, 4u, 8u}) {
      const uint64_t scene = h.scene({triangle_at(3, geometry)}, instance);
      for (const uint32_t ray : {0u, 1u, 2u}) {
        bool opaque = geometry == kOpaque;
        if (instance != 0) opaque = instance == 4;
        if (ray != 0) opaque = ray == 1;
        const Payload payload = trace_flags(h, scene, ray);
        EXPECT_EQ(payload.end, End::kClosestHit);
        EXPECT_EQ(payload.any_hits, opaque ? 0u : 1u)
            << "geometry " << static_cast<uint32_t>(geometry) << " instance " << instance << " ray "
            << ray;
      }
    }
  }
}

TEST(Flg13, NonOpaqueWithoutAnyHitShaderIsCommitted) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t scene = h.scene({triangle_at(3, kNonOpaque)});
  EXPECT_EQ(trace_flags(h, scene, 0).end, End::kClosestHit);
  EXPECT_EQ(trace_flags(h, scene, kRayForceNonOpaque).end, End::kClosestHit);
}

TEST(Flg14, ForceOpaqueRunsIntersectionButNoAnyHit) {
  Harness h;
  h.use_standard_pipeline(any_hit_ignore, report_all);
  report_log() = {{{3.5f, 1, {}}}, {}, {}, 0, {}};
  const uint64_t scene = h.scene({box_at(3, kNonOpaque)});
  Payload payload = trace_flags(h, scene, kRayForceOpaque);
  EXPECT_EQ(payload.end, End::kClosestHit);
  EXPECT_EQ(payload.any_hits, 0u);
  payload = trace_flags(h, scene, 0);
  EXPECT_EQ(payload.end, End::kMiss);
  EXPECT_EQ(payload.any_hits, 1u);
}

TEST(Flg15, CullsLookAtFlagsNotAtMissingAnyHitShaders) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t scene = h.scene({triangle_at(3, kNonOpaque)});
  EXPECT_EQ(trace_flags(h, scene, kRayCullOpaque).end, End::kClosestHit);
  EXPECT_EQ(trace_flags(h, scene, kRayCullNonOpaque).end, End::kMiss);
}

TEST(Flg15, CullsSeeTheInstancesOverride) {
  Harness h;
  h.use_standard_pipeline();
  for (const auto geometry : {kNonOpaque, kOpaque}) {
    const uint64_t opaque = h.scene({triangle_at(3, geometry)}, kInstanceForceOpaque);
    const uint64_t non_opaque = h.scene({triangle_at(3, geometry)}, kInstanceForceNonOpaque);
    EXPECT_EQ(trace_flags(h, opaque, kRayCullOpaque).end, End::kMiss);
    EXPECT_EQ(trace_flags(h, opaque, kRayCullNonOpaque).end, End::kClosestHit);
    EXPECT_EQ(trace_flags(h, non_opaque, kRayCullOpaque).end, End::kClosestHit);
    EXPECT_EQ(trace_flags(h, non_opaque, kRayCullNonOpaque).end, End::kMiss);
  }
}

TEST(Flg16, ACulledBoxNeverRunsItsIntersectionShader) {
  Harness h;
  h.use_standard_pipeline(nullptr, report_all);
  report_log() = {{{3.5f, 1, {}}}, {}, {}, 0, {}};
  EXPECT_EQ(trace_flags(h, h.scene({box_at(3, kOpaque)}), kRayCullOpaque).end, End::kMiss);
  EXPECT_EQ(trace_flags(h, h.scene({box_at(3, kNonOpaque)}), kRayCullNonOpaque).end, End::kMiss);
  EXPECT_EQ(report_log().calls, 0u);
}

TEST(Flg20, ClockwiseIsFront) {
  Harness h;
  h.use_standard_pipeline();
  GeometryInput input;
  input.vertices = {{0, 1, 3}, {1, 0, 3}, {-1, 0, 3}};
  input.flags = kOpaque;
  auto ray = ray_along_z(h.scene({input}), 0, 0.5f);
  EXPECT_EQ(h.trace(ray).values.hit_kind, 254u);
  std::swap(input.vertices[1], input.vertices[2]);
  ray.acceleration_structure = h.scene({input});
  EXPECT_EQ(h.trace(ray).values.hit_kind, 255u);
}

TEST(Flg21To23, FrontCounterclockwiseMirroredInstanceMirroredGeometry) {
  Harness h;
  h.use_standard_pipeline();
  const auto kind = [&](uint64_t scene) { return h.trace(ray_along_z(scene)).values.hit_kind; };
  EXPECT_EQ(kind(h.scene({triangle_at(3)}, kInstanceTriangleFrontCounterclockwise)), 255u);
  auto mirrored = instance_of(h.bottom_level({triangle_at(3)}));
  mirrored.Transform[0][0] = -1;
  EXPECT_EQ(kind(h.top_level({mirrored})), 254u);
  EXPECT_EQ(kind(h.scene({transformed(triangle_at(3), kMirror)})), 255u);
}

TEST(Flg24, FacingCullsComeBeforeAnyHitAndSpareBoxes) {
  Harness h;
  h.use_standard_pipeline(any_hit_accept, report_all);
  report_log() = {{{3.5f, 1, {}}}, {}, {}, 0, {}};
  for (const auto opacity : {kOpaque, kNonOpaque}) {
    const uint64_t front = h.scene({triangle_at(3, opacity)});
    Payload payload = trace_flags(h, front, kRayCullFrontFacingTriangles);
    EXPECT_EQ(payload.end, End::kMiss);
    EXPECT_EQ(payload.any_hits, 0u);
    EXPECT_EQ(trace_flags(h, front, kRayCullBackFacingTriangles).end, End::kClosestHit);
    const uint64_t back =
        h.scene({triangle_at(3, opacity)}, kInstanceTriangleFrontCounterclockwise);
    EXPECT_EQ(trace_flags(h, back, kRayCullBackFacingTriangles).end, End::kMiss);
    EXPECT_EQ(trace_flags(h, back, kRayCullFrontFacingTriangles).end, End::kClosestHit);
    const uint64_t box = h.scene({box_at(3, opacity)});
    EXPECT_EQ(trace_flags(h, box, kRayCullBackFacingTriangles).end, End::kClosestHit);
    EXPECT_EQ(trace_flags(h, box, kRayCullFrontFacingTriangles).end, End::kClosestHit);
  }
}

TEST(Flg24, VisibilityRaysCullFacesToo) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t front = h.scene({triangle_at(3)});
  constexpr uint32_t kVisibility = kRayAcceptFirstHitAndEndSearch | kRaySkipClosestHitShader;
  EXPECT_EQ(trace_flags(h, front, kVisibility | kRayCullFrontFacingTriangles).end, End::kMiss);
  EXPECT_EQ(trace_flags(h, front, kVisibility | kRayCullBackFacingTriangles).end, End::kNothing);
}

TEST(Flg25, CullDisableHoldsForFacingOnly) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t scene = h.scene({triangle_at(3)}, kInstanceTriangleCullDisable);
  EXPECT_EQ(trace_flags(h, scene, kRayCullFrontFacingTriangles).end, End::kClosestHit);
  EXPECT_EQ(trace_flags(h, scene, kRaySkipTriangles).end, End::kMiss);
  EXPECT_EQ(trace_flags(h, scene, kRayCullOpaque).end, End::kMiss);
}

TEST(Flg26, SkipFlagsDropAWholeClass) {
  Harness h;
  h.use_standard_pipeline(nullptr, report_all);
  report_log() = {{{5.5f, 1, {}}}, {}, {}, 0, {}};
  const uint64_t scene = h.top_level(
      {instance_of(h.bottom_level({triangle_at(3)})), instance_of(h.bottom_level({box_at(5)}))});
  EXPECT_TRUE(is_distance(trace_flags(h, scene, 0).values.t_current, 3.0f));
  EXPECT_EQ(trace_flags(h, scene, kRaySkipTriangles).values.t_current, 5.5f);
  report_log().calls = 0;
  EXPECT_TRUE(
      is_distance(trace_flags(h, scene, kRaySkipProceduralPrimitives).values.t_current, 3.0f));
  EXPECT_EQ(report_log().calls, 0u);
}

TEST(Flg27, PipelineFlagsCountButDoNotShow) {
  Harness h;
  PipelineBuilder builder;
  const auto rg = builder.ray_generation(trace_job);
  const auto missed = builder.miss(miss);
  builder.set_flags(rtapi::RaytracingPipelineFlags::kSkipTriangles);
  h.set_pipeline(builder, rg);
  h.set_miss_table({{missed, 0}});
  const Payload payload = trace_flags(h, h.scene({triangle_at(3)}), kRayForceOpaque);
  EXPECT_EQ(payload.end, End::kMiss);
  EXPECT_EQ(payload.values.ray_flags, uint32_t{kRayForceOpaque});
}

TEST(Flg30And31, TheMaskIsAnAndOfEightBits) {
  Harness h;
  h.use_standard_pipeline();
  auto instance = instance_of(h.bottom_level({triangle_at(3)}));
  for (uint32_t mask : {0u, 1u, 2u, 0x40u, 0x80u, 0xA5u, 0xFFu}) {
    instance.InstanceMask = mask;
    const uint64_t scene = h.top_level({instance});
    for (const uint32_t inclusion :
         {0u, 1u, 2u, 4u, 8u, 0x40u, 0x80u, 0xFFu, 0x100u, 0xFFFFFF00u}) {
      auto ray = ray_along_z(scene);
      ray.instance_inclusion_mask = inclusion;
      EXPECT_EQ(h.trace(ray).end, (mask & inclusion & 0xFF) != 0 ? End::kClosestHit : End::kMiss)
          << mask << " " << inclusion;
    }
  }
}

TEST(Flg32And34And35, AcceptFirstHitAndSkipClosestHit) {
  Harness h;
  h.use_standard_pipeline(any_hit_accept);
  for (const auto opacity : {kOpaque, kNonOpaque}) {
    const uint64_t scene = h.scene({triangle_at(3, opacity), triangle_at(5, opacity)});
    Payload payload = trace_flags(h, scene, kRayAcceptFirstHitAndEndSearch);
    EXPECT_EQ(payload.end, End::kClosestHit);
    EXPECT_EQ(payload.calls, 1u);
    EXPECT_EQ(payload.any_hits, opacity == kOpaque ? 0u : 1u);
    EXPECT_TRUE(is_distance(payload.values.t_current, 3) ||
                is_distance(payload.values.t_current, 5));
    payload = trace_flags(h, scene, kRaySkipClosestHitShader);
    EXPECT_EQ(payload.end, End::kNothing);
    payload = trace_flags(h, scene, kRayAcceptFirstHitAndEndSearch | kRaySkipClosestHitShader);
    EXPECT_EQ(payload.end, End::kNothing);
    EXPECT_EQ(payload.any_hits, opacity == kOpaque ? 0u : 1u);
  }
}

TEST(Flg33, AnIgnoredHitDoesNotEndTheSearch) {
  Harness h;
  h.use_standard_pipeline(any_hit_ignore);
  const uint64_t scene = h.scene({triangle_at(5, kOpaque), triangle_at(3, kNonOpaque)});
  const Payload payload = trace_flags(h, scene, kRayAcceptFirstHitAndEndSearch);
  EXPECT_EQ(payload.end, End::kClosestHit);
  EXPECT_TRUE(is_distance(payload.values.t_current, 5.0f));
  const Payload nothing = trace_flags(h, h.scene({triangle_at(3, kNonOpaque)}),
                                      kRayAcceptFirstHitAndEndSearch | kRaySkipClosestHitShader);
  EXPECT_EQ(nothing.end, End::kMiss);
  EXPECT_EQ(nothing.any_hits, 1u);
}

TEST(Flg37, OpaqueAppliesToBoxes) {
  Harness h;
  h.use_standard_pipeline(any_hit_ignore, report_all);
  report_log() = {{{3.5f, 1, {}}}, {}, {}, 0, {}};
  EXPECT_EQ(trace_flags(h, h.scene({box_at(3, kOpaque)}), 0).end, End::kClosestHit);
  EXPECT_EQ(trace_flags(h, h.scene({box_at(3, kOpaque)}), kRayForceNonOpaque).any_hits, 1u);
}

}  // namespace
}  // namespace kaamos::embree::testing
