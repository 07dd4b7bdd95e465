// SPDX-License-Identifier: MIT
//
// Intervals, any-hit shaders, the end of a search, inactive and degenerate input: rules TRV-nn.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "runtime/embree/ray_state.h"
#include "runtime/embree/testing/harness.h"

namespace kaamos::embree::testing {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Ray ray_with_interval(uint64_t scene, float t_min, float t_max) {
  auto ray = ray_along_z(scene);
  ray.ray.t_min = t_min;
  ray.ray.t_max = t_max;
  return ray;
}

TEST(Trv01, TScalesWithTheDirectionsLength) {
  Harness h;
  h.use_standard_pipeline();
  auto ray = ray_along_z(h.scene({triangle_at(8)}));
  ray.ray.direction[2] = 4;
  EXPECT_TRUE(is_distance(h.trace(ray).values.t_current, 2.0f));
}

TEST(Trv02, OneTForBothSpaces) {
  Harness h;
  h.use_standard_pipeline();
  auto instance = instance_of(h.bottom_level({triangle_at(1)}));
  instance.Transform[0][0] = 3;
  instance.Transform[1][1] = 0.5f;
  instance.Transform[2][2] = 4;
  instance.Transform[2][3] = 2;
  EXPECT_TRUE(is_distance(h.trace(ray_along_z(h.top_level({instance}))).values.t_current, 6.0f));
}

// The interval's ends are compared with the t that the traversal finds, however that is rounded.
TEST(Trv03, TrianglesAreHitInTheOpenInterval) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t scene = h.scene({triangle_at(4)});
  const float t = h.trace(ray_along_z(scene)).values.t_current;
  ASSERT_TRUE(is_distance(t, 4));
  const auto end = [&](float t_min, float t_max) {
    return h.trace(ray_with_interval(scene, t_min, t_max)).end;
  };
  EXPECT_EQ(end(t, 10), End::kMiss);
  EXPECT_EQ(end(0, t), End::kMiss);
  EXPECT_EQ(end(std::nextafterf(t, 0), 10), End::kClosestHit);
  EXPECT_EQ(end(0, std::nextafterf(t, 5)), End::kClosestHit);
  EXPECT_EQ(end(t, t), End::kMiss);
  EXPECT_EQ(end(0, kInf), End::kClosestHit);
}

TEST(Trv03, TheOpenIntervalHoldsForVisibilityRaysAndAnyHit) {
  Harness h;
  h.use_standard_pipeline(any_hit_accept);
  for (const auto opacity : {kOpaque, kNonOpaque}) {
    const uint64_t scene = h.scene({triangle_at(4, opacity)});
    for (const uint32_t flags :
         {0u, uint32_t{kRayForceNonOpaque},
          uint32_t{kRayAcceptFirstHitAndEndSearch | kRaySkipClosestHitShader}}) {
      // Another structure, tested exactly, may serve rays that force non-opaque.
      auto measuring = ray_along_z(scene);
      measuring.ray_flags = flags & kRayForceNonOpaque;
      const float t = h.trace(measuring).values.t_current;
      ASSERT_TRUE(is_distance(t, 4));
      const auto misses = [&](float t_min, float t_max) {
        auto ray = ray_with_interval(scene, t_min, t_max);
        ray.ray_flags = flags;
        const Payload payload = h.trace(ray);
        return payload.end == End::kMiss && payload.any_hits == 0;
      };
      EXPECT_TRUE(misses(t, 10));
      EXPECT_TRUE(misses(0, t));
      EXPECT_FALSE(misses(std::nextafterf(t, 0), std::nextafterf(t, 5)));
    }
  }
}

TEST(Trv03, NoHitAtTheOrigin) {
  Harness h;
  h.use_standard_pipeline();
  EXPECT_EQ(h.trace(ray_along_z(h.scene({triangle_at(0)}))).end, End::kMiss);
}

TEST(Trv06, OfCoincidentTrianglesOneIsAskedAbout) {
  Harness h;
  h.use_standard_pipeline(any_hit_accept);
  const Payload payload =
      h.trace(ray_along_z(h.scene({triangle_at(4, kNonOpaque), triangle_at(4, kNonOpaque)})));
  EXPECT_EQ(payload.any_hits, 1u);
  EXPECT_EQ(payload.end, End::kClosestHit);
}

TEST(Trv09, NanAndEmptyIntervalsMiss) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t scene = h.scene({triangle_at(4)});
  EXPECT_EQ(h.trace(ray_with_interval(scene, kNan, 10)).end, End::kMiss);
  EXPECT_EQ(h.trace(ray_with_interval(scene, 0, kNan)).end, End::kMiss);
  EXPECT_EQ(h.trace(ray_with_interval(scene, 9, 3)).end, End::kMiss);
  EXPECT_EQ(h.trace(ray_with_interval(scene, -5, -1)).end, End::kMiss);
  EXPECT_EQ(h.trace(ray_with_interval(scene, kInf, kInf)).end, End::kMiss);
  EXPECT_EQ(h.trace(ray_with_interval(scene, -5, 10)).end, End::kClosestHit);
  auto ray = ray_along_z(scene);
  ray.ray.origin[1] = kNan;
  EXPECT_EQ(h.trace(ray).end, End::kMiss);
  ray = ray_along_z(scene);
  ray.ray.direction[0] = kNan;
  EXPECT_EQ(h.trace(ray).end, End::kMiss);
}

// Embree squares coordinates in float.
TEST(FarRays, TheDispatchSaysThatTheyMiss) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t scene = h.scene({triangle_at(4)});
  auto ray = ray_along_z(scene);
  ray.ray.origin[2] = -2e18f;
  EXPECT_EQ(h.trace(ray).end, End::kMiss);
  ASSERT_EQ(h.messages.size(), 1u);
  EXPECT_EQ(h.messages[0].Id.text(), "KA0888");
  EXPECT_NE(h.messages[0].Text.find("(0, 0, -2e+18) along (0, 0, 1) has a coordinate past"),
            std::string::npos)
      << h.messages[0].Text;

  // Infinite rays, and rays whose interval is empty, miss by DXR's rules.
  h.messages.clear();
  ray.ray.t_max = -1;
  EXPECT_EQ(h.trace(ray).end, End::kMiss);
  ray = ray_along_z(scene);
  ray.ray.origin[2] = -kInf;
  EXPECT_EQ(h.trace(ray).end, End::kMiss);
  EXPECT_TRUE(h.messages.empty());
}

TEST(FarRays, TheMessageIsTheSameForAnyNumberOfThreads) {
  std::set<std::string> texts;
  for (const uint32_t threads : {1u, 2u, 4u}) {
    Harness h(threads);
    h.use_standard_pipeline();
    std::vector<Ray> rays(3000, ray_along_z(h.scene({triangle_at(4)})));
    for (size_t i = 0; i < rays.size(); ++i) {
      rays[i].ray.origin[1] = 2e18f * (1.0f + static_cast<float>(i * 7919 % rays.size()) / 64);
    }
    h.trace(rays);
    ASSERT_EQ(h.messages.size(), 1u);
    EXPECT_NE(h.messages[0].Text.find("3000 rays do"), std::string::npos) << h.messages[0].Text;
    EXPECT_NE(h.messages[0].Text.find("from (0, 2e+18, 0)"), std::string::npos);
    texts.insert(h.messages[0].Text);
  }
  EXPECT_EQ(texts.size(), 1u);
}

TEST(FarRays, AnInstanceCanMakeThemSo) {
  Harness h;
  h.use_standard_pipeline();
  auto instance = instance_of(h.bottom_level({triangle_at(4)}));
  for (int row = 0; row < 3; ++row) instance.Transform[row][row] = 1e-19f;
  const Payload payload = h.trace(ray_along_z(h.top_level({instance})));
  if (payload.end == End::kClosestHit) {  // exact traversals compute in double
    EXPECT_TRUE(h.messages.empty());
    return;
  }
  EXPECT_EQ(payload.end, End::kMiss);
  ASSERT_EQ(h.messages.size(), 1u);
  EXPECT_EQ(h.messages[0].Id.text(), "KA0888");
  EXPECT_NE(h.messages[0].Text.find("in the space of instance 0"), std::string::npos);
}

TEST(Trv10, ZeroDirectionMissesTriangles) {
  Harness h;
  h.use_standard_pipeline();
  auto ray = ray_along_z(h.scene({triangle_at(4)}));
  ray.ray.direction[2] = 0;
  EXPECT_EQ(h.trace(ray).end, End::kMiss);
}

TEST(Trv15, EveryTriangleIsAskedAboutOnce) {
  Harness h;
  h.use_standard_pipeline(any_hit_ignore);
  GeometryInput stack = triangle_at(2, kNonOpaque);
  for (int i = 1; i < 20; ++i) {
    for (const Vertex& v : triangle_at(2 + 0.25f * static_cast<float>(i)).vertices) {
      stack.vertices.push_back(v);
    }
  }
  const Payload payload = h.trace(ray_along_z(h.scene({stack})));
  EXPECT_EQ(payload.any_hits, 20u);
  EXPECT_EQ(payload.any_hit_primitives, (1u << 20) - 1);
  EXPECT_EQ(payload.end, End::kMiss);
}

TEST(Trv21, AnAcceptedHitShrinksTheInterval) {
  Harness h;
  h.use_standard_pipeline(any_hit_accept);
  std::vector<GeometryInput> stack;
  for (int i = 0; i < 16; ++i) {
    stack.push_back(triangle_at(2 + static_cast<float>((i * 7) % 16), kNonOpaque));
  }
  const Payload payload = h.trace(ray_along_z(h.scene(stack)));
  EXPECT_EQ(payload.end, End::kClosestHit);
  EXPECT_TRUE(is_distance(payload.values.t_current, 2.0f));
  EXPECT_EQ(payload.any_hit_t, payload.smallest_any_hit_t);
}

TEST(Trv23, AcceptAndEndSearchKeepsTheHitItAccepted) {
  Harness h;
  h.use_standard_pipeline(any_hit_end);
  const uint64_t scene =
      h.scene({triangle_at(3, kNonOpaque), triangle_at(5, kNonOpaque), triangle_at(7, kNonOpaque)});
  const Payload payload = h.trace(ray_along_z(scene));
  EXPECT_EQ(payload.any_hits, 1u);
  EXPECT_EQ(payload.end, End::kClosestHit);
  EXPECT_EQ(payload.values.t_current, payload.any_hit_t);
}

TEST(Trv23, TheSearchEndsAcrossInstances) {
  Harness h;
  h.use_standard_pipeline(any_hit_end);
  const uint64_t level = h.bottom_level({triangle_at(3, kNonOpaque)});
  std::vector<rtapi::RaytracingInstanceDesc> instances;
  for (int i = 0; i < 30; ++i) {
    instances.push_back(instance_of(level));
    instances.back().Transform[2][3] = static_cast<float>(i);
  }
  EXPECT_EQ(h.trace(ray_along_z(h.top_level(instances))).any_hits, 1u);
}

TEST(Trv28, ARejectedCandidateLeavesTheCommittedHitWhole) {
  Harness h;
  h.use_standard_pipeline([](shader::Invocation& invocation, void* payload, const void* a) {
    any_hit_ignore(invocation, payload, a);
    return invocation.ray->primitive_index == 3 ? shader::AnyHitResult::kAccept
                                                : shader::AnyHitResult::kIgnore;
  });
  GeometryInput stack;
  stack.flags = kNonOpaque;
  for (int i = 0; i < 8; ++i) {
    for (Vertex v : triangle_at(2 + static_cast<float>(i)).vertices) {
      v.x += 0.1f * static_cast<float>(i);
      stack.vertices.push_back(v);
    }
  }
  const Payload payload = h.trace(ray_along_z(h.scene({stack})));
  EXPECT_EQ(payload.values.primitive_index, 3u);
  EXPECT_TRUE(is_distance(payload.values.t_current, 5.0f));
  float barycentrics[2];
  std::memcpy(barycentrics, payload.attributes, 8);
  // The hit point of primitive 3, computed from its vertices.
  const auto& v = stack.vertices;
  const float x = v[9].x * (1 - barycentrics[0] - barycentrics[1]) + v[10].x * barycentrics[0] +
                  v[11].x * barycentrics[1];
  EXPECT_NEAR(x, 0, 1e-5);
}

TEST(Trv24To26, AnyHitCallsComeOneAtATimeBeforeTheClosestHit) {
  Harness h(2);
  // `user` counts all calls; the closest-hit shader must see every any-hit call in it.
  PipelineBuilder builder;
  const auto rg = builder.ray_generation(trace_job);
  const auto hit = builder.hit_group(
      [](shader::Invocation& invocation, void* data, const void* attributes) {
        auto& payload = *static_cast<Payload*>(data);
        EXPECT_EQ(payload.user, payload.any_hits);
        closest_hit(invocation, data, attributes);
      },
      [](shader::Invocation& invocation, void* data, const void* attributes) {
        auto& payload = *static_cast<Payload*>(data);
        ++payload.user;  // persists, whatever the answer
        const auto ignored = any_hit_ignore(invocation, data, attributes);
        return invocation.ray->primitive_index == 9 ? shader::AnyHitResult::kAccept : ignored;
      });
  h.set_pipeline(builder, rg);
  h.set_hit_table({{hit, 0}});
  GeometryInput stack;
  stack.flags = rtapi::RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation;
  for (int i = 0; i < 10; ++i) {
    for (const Vertex& v : triangle_at(2 + static_cast<float>(i)).vertices) {
      stack.vertices.push_back(v);
    }
  }
  const std::vector<Ray> rays(500, ray_along_z(h.scene({stack})));
  for (const Payload& payload : h.trace(rays)) {
    EXPECT_EQ(payload.any_hits, 10u);
    EXPECT_EQ(payload.end, End::kClosestHit);
  }
}

TEST(Trv46, NullStructureIsAMiss) {
  Harness h;
  h.use_standard_pipeline();
  EXPECT_EQ(h.trace(ray_along_z(0)).end, End::kMiss);
  EXPECT_TRUE(h.messages.empty());
}

TEST(Trv55, ATriangleWithANanXIsInactiveAndKeepsItsIndex) {
  for (int corner = 0; corner < 3; ++corner) {
    Harness h;
    h.use_standard_pipeline();
    GeometryInput input = triangle_at(3);
    input.vertices[corner].x = kNan;
    for (const Vertex& v : triangle_at(5).vertices) input.vertices.push_back(v);
    const Payload payload = h.trace(ray_along_z(h.scene({input})));
    EXPECT_TRUE(is_distance(payload.values.t_current, 5.0f));
    EXPECT_EQ(payload.values.primitive_index, 1u);
  }
}

TEST(Trv56And58, InactiveBoxesAndInstancesKeepTheirIndices) {
  Harness h;
  h.use_standard_pipeline(nullptr, report_all);
  report_log() = {{{5.5f, 1, {}}}, {}, {}, 0, {}};
  GeometryInput boxes;
  boxes.boxes = {{kNan, -1, 2, 1, 1, 3}, {-1, -1, 5, 1, 1, 6}};
  boxes.flags = kOpaque;
  const uint64_t level = h.bottom_level({boxes});
  const Payload payload = h.trace(ray_along_z(h.top_level({instance_of(0), instance_of(level)})));
  EXPECT_EQ(payload.end, End::kClosestHit);
  EXPECT_EQ(payload.values.primitive_index, 1u);
  EXPECT_EQ(payload.values.instance_index, 1u);
  EXPECT_EQ(report_log().primitives, std::vector<uint32_t>{1});
}

TEST(Trv57, ANanInTheTransformDeactivatesTheGeometry) {
  Harness h;
  h.use_standard_pipeline();
  GeometryInput input = triangle_at(3);
  input.transform = {kNan, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  EXPECT_EQ(h.trace(ray_along_z(h.scene({input, triangle_at(5)}))).values.geometry_index, 1u);
  EXPECT_EQ(h.trace(ray_along_z(h.scene({input}))).end, End::kMiss);
}

TEST(Trv59, NanAndInfinityInOtherPlacesDoNoHarm) {
  Harness h;
  h.use_standard_pipeline();
  for (const float bad : {kNan, kInf, -kInf, 1e30f, 3e38f}) {
    GeometryInput input = triangle_at(3);
    input.vertices[1].y = bad;
    EXPECT_TRUE(
        is_distance(h.trace(ray_along_z(h.scene({input, triangle_at(5)}))).values.t_current, 5.0f))
        << bad;
  }
}

TEST(Trv62And63, DegenerateTrianglesAreNeverHit) {
  Harness h;
  h.use_standard_pipeline();
  GeometryInput input;
  input.flags = kOpaque;
  input.vertices = {{0, 0, 3}, {0, 0, 3}, {0, 0, 3}, {-1, 0, 4}, {0, 0, 4}, {1, 0, 4}};
  EXPECT_EQ(h.trace(ray_along_z(h.scene({input}))).end, End::kMiss);
}

TEST(Trv65, AnInvertedBoxIsAPointAtItsCentre) {
  Harness h;
  h.use_standard_pipeline(nullptr, report_all);
  report_log() = {{{3.0f, 1, {}}}, {}, {}, 0, {}};
  GeometryInput input;
  input.boxes = {{4, 4, 4, -2, -2, 2}};
  input.flags = kOpaque;
  const uint64_t scene = h.scene({input});
  EXPECT_EQ(h.trace(ray_along_z(scene, 1, 1)).end, End::kClosestHit);
}

TEST(Trv67, ATopLevelOfEmptyBottomLevelsMisses) {
  Harness h;
  h.use_standard_pipeline();
  GeometryInput nothing;
  const uint64_t empty = h.bottom_level({nothing});
  const uint64_t none = h.bottom_level({});
  EXPECT_EQ(h.trace(ray_along_z(h.top_level({instance_of(empty), instance_of(none)}))).end,
            End::kMiss);
  EXPECT_EQ(h.trace(ray_along_z(h.top_level({}))).end, End::kMiss);
}

// A closed box of 12 triangles around the origin, hit from inside in random directions: no ray
// escapes.
TEST(Trv72, NoRayEscapesFromAClosedBox) {
  Harness h(2);
  h.use_standard_pipeline();
  for (const float scale : {0x1p-20f, 1.0f, 0x1p20f}) {
    GeometryInput box;
    box.flags = kOpaque;
    for (int i = 0; i < 8; ++i) {
      box.vertices.push_back({scale * (i & 1 ? 1.0f : -1.0f), scale * (i & 2 ? 1.0f : -1.0f),
                              scale * (i & 4 ? 1.0f : -1.0f)});
    }
    box.indices = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                   2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    const uint64_t scene = h.scene({box});
    std::vector<Ray> rays;
    uint32_t state = 12345;
    const auto random = [&] {
      state = state * 1664525u + 1013904223u;
      return static_cast<float>(state >> 8) * 0x1p-23f - 1.0f;
    };
    for (int i = 0; i < 20000; ++i) {
      auto ray = ray_along_z(scene);
      ray.ray = {{0.9f * scale * random(), 0.9f * scale * random(), 0.9f * scale * random()},
                 0,
                 {random(), random(), random()},
                 kInf};
      rays.push_back(ray);
    }
    size_t escaped = 0;
    for (const Payload& payload : h.trace(rays)) escaped += payload.end != End::kClosestHit;
    EXPECT_EQ(escaped, 0u) << "scale " << scale;
  }
}

}  // namespace
}  // namespace kaamos::embree::testing
