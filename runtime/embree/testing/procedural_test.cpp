// SPDX-License-Identifier: MIT
//
// Intersection shaders and ReportHit: rules TRV-04, 07, 16 to 19, 35 to 43.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/embree/ray_state.h"
#include "runtime/embree/testing/harness.h"

namespace kaamos::embree::testing {
namespace {

using Results = std::vector<shader::ReportHitResult>;
constexpr auto kRejected = shader::ReportHitResult::kRejected;
constexpr auto kAccepted = shader::ReportHitResult::kAccepted;
constexpr auto kEndSearch = shader::ReportHitResult::kEndSearch;

void set_reports(std::vector<Report> reports) {
  report_log() = {};
  report_log().reports = std::move(reports);
}

Ray with_interval(uint64_t scene, float t_min, float t_max) {
  auto ray = ray_along_z(scene);
  ray.ray.t_min = t_min;
  ray.ray.t_max = t_max;
  return ray;
}

TEST(Trv04, BoxesAreHitInTheClosedInterval) {
  Harness h;
  h.use_standard_pipeline(nullptr, report_all);
  const uint64_t scene = h.scene({box_at(3)});
  for (const float t : {3.25f, 3.5f}) {
    set_reports({{t, 1, {}}});
    EXPECT_EQ(h.trace(with_interval(scene, 3.25f, 3.5f)).end, End::kClosestHit) << t;
  }
  for (const float t : {std::nextafterf(3.25f, 0), std::nextafterf(3.5f, 9), -1.0f,
                        std::numeric_limits<float>::quiet_NaN()}) {
    set_reports({{t, 1, {}}});
    EXPECT_EQ(h.trace(with_interval(scene, 3.25f, 3.5f)).end, End::kMiss) << t;
    EXPECT_EQ(report_log().results, Results{kRejected});
  }
  set_reports({{3.5f, 1, {}}});
  EXPECT_EQ(h.trace(with_interval(scene, 3.5f, 3.5f)).end, End::kClosestHit);
}

TEST(Trv07, AnEqualTReportReplacesTheHit) {
  Harness h;
  h.use_standard_pipeline(any_hit_accept, report_all);
  set_reports({{3.5f, 10, {}}, {3.5f, 20, {}}});
  const Payload payload = h.trace(ray_along_z(h.scene({box_at(3, kNonOpaque)})));
  EXPECT_EQ(payload.values.hit_kind, 20u);
  EXPECT_EQ(payload.any_hits, 2u);
}

TEST(Trv17, BoxFacesDoNotClip) {
  Harness h;
  h.use_standard_pipeline(nullptr, report_all);
  set_reports({{77.0f, 1, {}}});
  EXPECT_EQ(h.trace(ray_along_z(h.scene({box_at(3)}))).values.t_current, 77.0f);
}

TEST(Trv18, ARayFromInsideABoxRunsItsShader) {
  Harness h;
  h.use_standard_pipeline(nullptr, report_all);
  set_reports({{0.25f, 1, {}}});
  EXPECT_EQ(h.trace(ray_along_z(h.scene({box_at(-0.5f)}))).end, End::kClosestHit);
}

TEST(Trv19, FlatBoxesAndTouchedFacesAreNotLost) {
  Harness h;
  h.use_standard_pipeline(nullptr, report_all);
  GeometryInput plate;
  plate.boxes = {{-1, -1, 3, 1, 1, 3}};
  plate.flags = kOpaque;
  const uint64_t scene = h.scene({plate});
  for (int i = 0; i < 200; ++i) {
    set_reports({{1.0f, 1, {}}});
    auto ray = ray_along_z(scene);
    const float x = 0.01f * static_cast<float>(i) - 1;
    ray.ray.origin[0] = -3 * x;
    ray.ray.direction[0] = 4 * x;
    ray.ray.direction[1] = 0.3f * x;
    ray.ray.direction[2] = 3;
    EXPECT_EQ(h.trace(ray).end, End::kClosestHit) << i;
  }
  // Along the edges of the box, and in the plane of the plate.
  set_reports({{1.0f, 1, {}}});
  EXPECT_EQ(h.trace(ray_along_z(scene, 1, 1)).end, End::kClosestHit);
  auto ray = ray_along_z(scene);
  ray.ray = {{-5, 0, 3}, 0, {1, 0, 0}, 100};
  EXPECT_EQ(h.trace(ray).end, End::kClosestHit);
}

// Boxes share leaves in the trees that can be updated or are built fast; a shader runs for those
// that the ray meets. [DXR: AABB volume]
TEST(Trv16, BoxesOfOneLeafAreTestedOneByOne) {
  using BuildFlags = rtapi::RaytracingAccelerationStructureBuildFlags;
  GeometryInput row;
  for (int i = 0; i < 32; ++i) {
    const float x = 3 * static_cast<float>(i % 8), z = 4 * static_cast<float>(i / 8);
    row.boxes.push_back({x, 0, z + 1, x + 1, 1, z + 2});
  }
  row.flags = kNonOpaque;
  for (const auto flags :
       {BuildFlags::kNone, BuildFlags::kAllowUpdate, BuildFlags::kPreferFastBuild}) {
    Harness h;
    h.use_standard_pipeline(any_hit_ignore, report_all);
    auto command = h.bottom_level_command({row}, flags);
    ASSERT_TRUE(h.execute(command).ok());
    const uint64_t scene = h.top_level({instance_of(command.dest)});
    for (uint32_t column = 0; column < 8; ++column) {
      const float x = 3 * static_cast<float>(column) + 0.5f;
      for (uint32_t reached = 0; reached < 4; ++reached) {
        // Up to the middle of a box; those behind TMax do not run.
        auto ray = ray_along_z(scene, x, 0.5f);
        ray.ray.t_max = 4 * static_cast<float>(reached) + 1.5f;
        set_reports({{0.5f, 1, {}}});
        EXPECT_EQ(h.trace(ray).any_hits, reached + 1);
        auto met = report_log().primitives;
        std::sort(met.begin(), met.end());
        std::vector<uint32_t> expected;
        for (uint32_t i = 0; i <= reached; ++i) expected.push_back(8 * i + column);
        EXPECT_EQ(met, expected) << column;
        set_reports({{0.5f, 1, {}}});
        ray.ray_flags = kRayAcceptFirstHitAndEndSearch | kRaySkipClosestHitShader;
        EXPECT_EQ(h.trace(ray).any_hits, reached + 1);
      }
      set_reports({{1, 1, {}}});
      EXPECT_EQ(h.trace(ray_along_z(scene, x + 1, 0.5f)).any_hits, 0u);  // between two columns
    }
  }
}

// The box of an instance in the world is larger than the turned box inside of it.
TEST(Trv16, ASingleBoxIsTestedToo) {
  using BuildFlags = rtapi::RaytracingAccelerationStructureBuildFlags;
  GeometryInput input = box_at(5, kNonOpaque);
  input.boxes.push_back({std::nanf(""), 0, 0, 1, 1, 1});  // inactive: no leaf
  for (const auto flags :
       {BuildFlags::kNone, BuildFlags::kAllowUpdate, BuildFlags::kPreferFastBuild}) {
    Harness h;
    h.use_standard_pipeline(any_hit_ignore, report_all);
    auto command = h.bottom_level_command({input}, flags);
    ASSERT_TRUE(h.execute(command).ok());
    auto turned = instance_of(command.dest);  // by 45 degrees around z
    const float s = std::sqrt(0.5f);
    turned.Transform[0][0] = turned.Transform[1][1] = s;
    turned.Transform[0][1] = -s;
    turned.Transform[1][0] = s;
    const uint64_t scene = h.top_level({turned});
    set_reports({{5, 1, {}}});
    EXPECT_EQ(h.trace(ray_along_z(scene)).any_hits, 1u);
    EXPECT_EQ(report_log().calls, 1u);
    set_reports({{5, 1, {}}});
    EXPECT_EQ(h.trace(ray_along_z(scene, 1.2f, 1.2f)).any_hits, 0u);
    EXPECT_EQ(report_log().calls, 0u);
  }
}

TEST(Trv36And37And38, EachReportIsTestedAgainstTheIntervalOfThen) {
  Harness h;
  h.use_standard_pipeline(nullptr, report_all);
  set_reports({{5, 1, {}}, {3, 2, {}}, {4, 3, {}}});
  const Payload payload = h.trace(ray_along_z(h.scene({box_at(3)})));
  EXPECT_EQ(payload.values.t_current, 3.0f);
  EXPECT_EQ(payload.values.hit_kind, 2u);
  EXPECT_EQ(report_log().results, (Results{kAccepted, kAccepted, kRejected}));
  EXPECT_EQ(report_log().t_current, (std::vector<float>{5, 3, 3}));
}

TEST(Trv36, ReportHitIsFalseWhereAnyHitIgnores) {
  Harness h;
  h.use_standard_pipeline(any_hit_ignore, report_all);
  set_reports({{5, 1, {}}, {3, 2, {}}});
  const Payload payload = h.trace(ray_along_z(h.scene({box_at(3, kNonOpaque)})));
  EXPECT_EQ(payload.end, End::kMiss);
  EXPECT_EQ(payload.any_hits, 2u);
  EXPECT_EQ(report_log().results, (Results{kRejected, kRejected}));
  EXPECT_EQ(report_log().t_current, (std::vector<float>{100, 100}));
}

TEST(Trv39, ReportHitDoesNotReturnOnceTheSearchHasEnded) {
  Harness h;
  h.use_standard_pipeline(any_hit_end, report_all);
  const uint64_t non_opaque = h.scene({box_at(3, kNonOpaque)});
  set_reports({{5, 1, {}}, {3, 2, {}}});
  Payload payload = h.trace(ray_along_z(non_opaque));
  EXPECT_EQ(report_log().results, Results{kEndSearch});
  EXPECT_EQ(payload.values.t_current, 5.0f);
  EXPECT_EQ(payload.end, End::kClosestHit);
  set_reports({{5, 1, {}}, {3, 2, {}}});
  auto ray = ray_along_z(h.scene({box_at(3, kOpaque)}));
  ray.ray_flags = kRayAcceptFirstHitAndEndSearch;
  payload = h.trace(ray);
  EXPECT_EQ(report_log().results, Results{kEndSearch});
  EXPECT_EQ(payload.values.t_current, 5.0f);
}

TEST(Trv39, AVisibilityRayAgainstBoxesHitsOrMisses) {
  Harness h;
  h.use_standard_pipeline(any_hit_accept, report_all);
  auto ray = ray_along_z(h.scene({box_at(3, kNonOpaque)}));
  ray.ray_flags = kRayAcceptFirstHitAndEndSearch | kRaySkipClosestHitShader;
  set_reports({{5, 1, {}}});
  EXPECT_EQ(h.trace(ray).end, End::kNothing);
  EXPECT_EQ(report_log().results, Results{kEndSearch});
  set_reports({{500, 1, {}}});
  EXPECT_EQ(h.trace(ray).end, End::kMiss);
}

TEST(Trv40And43, KindAndAttributesAreThoseOfTheCommittedReport) {
  Harness h;
  h.use_standard_pipeline(
      [](shader::Invocation& invocation, void*, const void* attributes) {
        uint32_t first;
        std::memcpy(&first, attributes, 4);
        EXPECT_EQ(invocation.ray->hit_kind, first);
        return first == 127 ? shader::AnyHitResult::kAccept : shader::AnyHitResult::kIgnore;
      },
      report_all);
  set_reports({{5, 127, {127, 2, 3, 4, 5, 6, 7, 8}}, {4, 1, {1, 9, 9, 9, 9, 9, 9, 9}}});
  const Payload payload = h.trace(ray_along_z(h.scene({box_at(3, kNonOpaque)})));
  EXPECT_EQ(payload.values.hit_kind, 127u);
  EXPECT_EQ(payload.values.t_current, 5.0f);
  for (uint32_t i = 1; i < 8; ++i) EXPECT_EQ(payload.attributes[i], i + 1);
}

TEST(Sv05, RayTCurrentByStage) {
  Harness h;
  h.use_standard_pipeline(any_hit_accept, report_all);
  // The intersection shader sees the closest hit so far, the triangle's; any-hit sees the
  // candidate's.
  const uint64_t scene = h.top_level({instance_of(h.bottom_level({triangle_at(2)})),
                                      instance_of(h.bottom_level({box_at(1, kNonOpaque)}))});
  set_reports({{50, 1, {}}});
  auto ray = ray_along_z(scene);
  EXPECT_TRUE(is_distance(h.trace(ray).values.t_current, 2.0f));
  set_reports({{1.5f, 1, {}}});
  Payload payload = h.trace(ray);
  EXPECT_EQ(payload.values.t_current, 1.5f);
  EXPECT_EQ(payload.any_hit_t, 1.5f);
  // The miss shader sees RayDesc.TMax, whatever was rejected before.
  h.use_standard_pipeline(any_hit_ignore, report_all);
  ray = ray_along_z(h.scene({triangle_at(2, kNonOpaque)}));
  ray.ray.t_max = std::numeric_limits<float>::infinity();
  payload = h.trace(ray);
  EXPECT_EQ(payload.end, End::kMiss);
  EXPECT_EQ(payload.values.t_current, std::numeric_limits<float>::infinity());
}

TEST(Trv07, ABoxBehindATriangleAtTheSameTWins) {
  Harness h;
  h.use_standard_pipeline(nullptr, report_all);
  // Instances may be visited in any order: either the triangle comes first and the box replaces it,
  // or the box comes first and the triangle, at the end of the open interval, is no hit.
  const uint64_t triangle = h.bottom_level({triangle_at(3)});
  const float t = h.trace(ray_along_z(h.top_level({instance_of(triangle)}))).values.t_current;
  ASSERT_TRUE(is_distance(t, 3));
  set_reports({{t, 42, {}}});
  const uint64_t box = h.bottom_level({box_at(1)});
  EXPECT_EQ(
      h.trace(ray_along_z(h.top_level({instance_of(triangle), instance_of(box)}))).values.hit_kind,
      42u);
}

}  // namespace
}  // namespace kaamos::embree::testing
