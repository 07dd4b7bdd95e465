// SPDX-License-Identifier: MIT
//
// Inline ray tracing: rules RQ-01 to 13 and 15 to 17. The compiler checks RQ-14: tests/hlsl.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>

#include "kaamos/shader/ray_query.h"
#include "runtime/embree/ray_state.h"
#include "runtime/embree/testing/harness.h"

namespace kaamos::embree::testing {
namespace {

using shader::Invocation;
using shader::RayQuery;

std::function<void(Invocation&)>& body() {
  static std::function<void(Invocation&)> function;
  return function;
}
void run_body(Invocation& invocation) {
  body()(invocation);
}
shader::AnyHitResult run_body_in_any_hit(Invocation& invocation, void*, const void*) {
  body()(invocation);
  return shader::AnyHitResult::kIgnore;
}

// Runs `shader` once, as ray generation.
void run(Harness& h, std::function<void(Invocation&)> shader) {
  body() = std::move(shader);
  PipelineBuilder builder;
  const auto identifier = builder.ray_generation(run_body);
  h.set_pipeline(builder, identifier);
  const uint32_t root = 0;
  ASSERT_TRUE(h.dispatch(1, 1, 1, &root, sizeof(root)));
}

void trace(Invocation& invocation, RayQuery& query, const Ray& ray, uint32_t flags = 0,
           uint32_t mask = 0xFF) {
  shader::Descriptor scene;
  scene.kind = shader::DescriptorKind::kAccelerationStructure;
  scene.address = ray.acceleration_structure;
  shader::begin_query(invocation, query, scene, flags, mask, ray.ray);
}

// The t of all candidates, committing none of them.
std::vector<float> candidates(Invocation& invocation, RayQuery& query) {
  std::vector<float> all;
  while (query_proceed(invocation, query)) all.push_back(query.candidate.t);
  return all;
}

bool are_only(const std::vector<float>& all, float t) {
  return all.size() == 1 && is_distance(all[0], t);
}

TEST(Rq01, FlagsAreThoseOfTheQueryAndNotOfThePipeline) {
  Harness h;
  const uint64_t scene = h.scene({triangle_at(2, kNonOpaque), triangle_at(3, kOpaque)});
  run(h, [&](Invocation& i) {
    RayQuery q;
    trace(i, q, ray_along_z(scene), kRayCullOpaque | 0x10000u);
    EXPECT_EQ(q.ray_flags, uint32_t{kRayCullOpaque});
    EXPECT_TRUE(are_only(candidates(i, q), 2));
    EXPECT_EQ(q.committed.type, 0u);
    trace(i, q, ray_along_z(scene), kRayForceOpaque);
    EXPECT_FALSE(query_proceed(i, q));
    EXPECT_TRUE(is_distance(q.committed.t, 2.0f));
    trace(i, q, ray_along_z(scene), kRaySkipTriangles);
    EXPECT_FALSE(query_proceed(i, q));
    EXPECT_EQ(q.committed.type, 0u);
  });
}

TEST(Rq02, TracingAgainStartsAnew) {
  Harness h;
  const uint64_t scene = h.scene({triangle_at(2, kNonOpaque), triangle_at(3, kNonOpaque)});
  run(h, [&](Invocation& i) {
    RayQuery q;
    trace(i, q, ray_along_z(scene));
    EXPECT_EQ(q.committed.type, 0u);
    EXPECT_TRUE(query_proceed(i, q));
    query_commit_triangle(q);
    trace(i, q, ray_along_z(scene));
    EXPECT_EQ(q.committed.type, 0u);
    EXPECT_EQ(q.committed.t, 100.0f);
    EXPECT_EQ(candidates(i, q).size(), 2u);
  });
}

TEST(Rq03, OpaqueTrianglesAreCommittedInSilenceAndBoxesAlwaysShown) {
  Harness h;
  const uint64_t triangles = h.scene({triangle_at(2, kNonOpaque), triangle_at(3, kOpaque),
                                      triangle_at(4, kNonOpaque), triangle_at(5, kOpaque)});
  const uint64_t boxes = h.scene({box_at(6, kOpaque), box_at(8, kNonOpaque)});
  run(h, [&](Invocation& i) {
    RayQuery q;
    trace(i, q, ray_along_z(triangles));
    EXPECT_TRUE(are_only(candidates(i, q), 2));
    EXPECT_EQ(q.committed.type, shader::kCommittedTriangle);
    EXPECT_TRUE(is_distance(q.committed.t, 3.0f));
    EXPECT_EQ(q.committed.geometry_index, 1u);
    EXPECT_TRUE(q.committed.front_face);

    std::vector<bool> non_opaque(2);
    trace(i, q, ray_along_z(boxes));
    while (query_proceed(i, q)) {
      EXPECT_EQ(q.candidate.type, shader::kQueryProcedural);
      non_opaque[q.candidate.geometry_index] = q.candidate.non_opaque;
    }
    EXPECT_EQ(non_opaque, (std::vector<bool>{false, true}));  // RQ-12
    EXPECT_EQ(q.committed.type, 0u);
  });
}

TEST(FarRays, AQueryEndsAtOnceAndTheDispatchSaysSo) {
  Harness h;
  const uint64_t scene = h.scene({triangle_at(2)});
  run(h, [&](Invocation& i) {
    RayQuery q;
    Ray ray = ray_along_z(scene);
    ray.ray.origin[0] = 2e18f;
    trace(i, q, ray);
    EXPECT_FALSE(query_proceed(i, q));
    EXPECT_EQ(q.committed.type, 0u);
  });
  ASSERT_EQ(h.messages.size(), 1u);
  EXPECT_EQ(h.messages[0].Id.text(), "KA0888");
}

TEST(Rq05, FalseIsFinal) {
  Harness h;
  const uint64_t scene = h.scene({triangle_at(2, kNonOpaque)});
  run(h, [&](Invocation& i) {
    RayQuery q;
    EXPECT_FALSE(query_proceed(i, q));  // before any TraceRayInline
    trace(i, q, ray_along_z(scene));
    EXPECT_TRUE(query_proceed(i, q));
    for (int k = 0; k < 5; ++k) EXPECT_FALSE(query_proceed(i, q));
    query_commit_triangle(q);  // there is no longer a candidate
    EXPECT_EQ(q.committed.type, 0u);
  });
}

TEST(Rq06, AbortKeepsWhatIsCommitted) {
  Harness h;
  const uint64_t scene = h.scene({triangle_at(2, kNonOpaque), triangle_at(3, kNonOpaque)});
  run(h, [&](Invocation& i) {
    RayQuery q;
    trace(i, q, ray_along_z(scene));
    EXPECT_TRUE(query_proceed(i, q));
    query_commit_triangle(q);
    query_abort(q);
    EXPECT_FALSE(query_proceed(i, q));
    EXPECT_EQ(q.committed.type, shader::kCommittedTriangle);
    EXPECT_TRUE(is_distance(q.committed.t, 2.0f));
  });
}

TEST(Rq07, ASecondCommitChangesNothing) {
  Harness h;
  const uint64_t scene = h.scene({triangle_at(2, kNonOpaque), triangle_at(3, kNonOpaque)});
  run(h, [&](Invocation& i) {
    RayQuery q;
    trace(i, q, ray_along_z(scene));
    EXPECT_TRUE(query_proceed(i, q));
    query_commit_triangle(q);
    query_commit_triangle(q);
    query_commit_procedural(q, 1.0f);  // wrong kind
    EXPECT_EQ(q.committed.type, shader::kCommittedTriangle);
    EXPECT_TRUE(is_distance(q.committed.t, 2.0f));
    EXPECT_FALSE(query_proceed(i, q));  // the other one is behind it
  });
}

TEST(Rq08, ABoxMayBeHitSeveralTimesAndNotOutsideTheRay) {
  Harness h;
  const uint64_t scene = h.scene({box_at(3)});
  run(h, [&](Invocation& i) {
    RayQuery q;
    trace(i, q, ray_along_z(scene));
    ASSERT_TRUE(query_proceed(i, q));
    for (const float t : {-1.0f, 101.0f, std::numeric_limits<float>::quiet_NaN()}) {
      query_commit_procedural(q, t);
      EXPECT_EQ(q.committed.type, 0u) << t;
    }
    query_commit_procedural(q, 3.75f);
    query_commit_procedural(q, 3.25f);
    query_commit_procedural(q, 3.5f);  // farther
    query_commit_triangle(q);
    EXPECT_EQ(q.committed.type, shader::kCommittedProcedural);
    EXPECT_EQ(q.committed.t, 3.25f);
    EXPECT_FALSE(query_proceed(i, q));
  });
}

TEST(Rq09, TheFirstHitEndsTheSearch) {
  Harness h;
  const uint64_t scene = h.scene({triangle_at(2, kNonOpaque), triangle_at(3, kNonOpaque)});
  const uint64_t opaque = h.scene({triangle_at(2, kNonOpaque), triangle_at(3, kOpaque)});
  run(h, [&](Invocation& i) {
    RayQuery q;
    trace(i, q, ray_along_z(scene), kRayAcceptFirstHitAndEndSearch);
    EXPECT_TRUE(query_proceed(i, q));
    query_commit_triangle(q);
    EXPECT_FALSE(query_proceed(i, q));
    trace(i, q, ray_along_z(scene), kRayAcceptFirstHitAndEndSearch);
    EXPECT_EQ(candidates(i, q).size(), 2u);
    EXPECT_EQ(q.committed.type, 0u);
    trace(i, q, ray_along_z(opaque), kRayAcceptFirstHitAndEndSearch);
    while (query_proceed(i, q)) {
    }
    EXPECT_EQ(q.committed.type, shader::kCommittedTriangle);
    EXPECT_TRUE(is_distance(q.committed.t, 3.0f));
    EXPECT_EQ(q.committed.geometry_index, 1u);
    EXPECT_TRUE(q.committed.front_face);
  });
}

TEST(Rq13, ValuesOfCandidateAndHit) {
  Harness h;
  const uint64_t level = h.bottom_level({triangle_at(1, kNonOpaque), triangle_at(2, kNonOpaque)});
  auto first = instance_of(level);
  first.InstanceMask = 1;
  auto second = instance_of(level);
  second.InstanceMask = 2;
  second.InstanceID = 77;
  second.InstanceContributionToHitGroupIndex = 0xABCDEF;
  second.Transform[2][3] = 4;
  const uint64_t scene = h.top_level({first, second});
  run(h, [&](Invocation& i) {
    RayQuery q;
    trace(i, q, ray_along_z(scene), 0, 2);
    ASSERT_TRUE(query_proceed(i, q));
    EXPECT_EQ(q.candidate.instance_index, 1u);
    EXPECT_EQ(q.candidate.instance_id, 77u);
    EXPECT_EQ(q.candidate.instance_contribution, 0xABCDEFu);  // RQ-17, and nothing more
    EXPECT_EQ(q.candidate.geometry_index, 0u);
    EXPECT_TRUE(is_distance(q.candidate.t, 5.0f));
    EXPECT_EQ(query_object_origin(q, q.candidate).e[2], -4.0f);
    EXPECT_EQ(query_object_direction(q, q.candidate).e[2], 1.0f);
    ASSERT_TRUE(query_proceed(i, q));
    query_commit_triangle(q);
    EXPECT_EQ(q.committed.geometry_index, 1u);
    EXPECT_EQ(q.committed.object_to_world[11], 4.0f);
    EXPECT_EQ(q.committed.world_to_object[11], -4.0f);
  });
}

// RQ-15, with more candidates than are kept at once and commits at any time.
TEST(Rq15, EachCandidateOnceWhateverIsCommittedAndHoweverQueriesInterleave) {
  Harness h;
  std::mt19937 random(7);
  std::vector<GeometryInput> geometries;
  std::vector<float> depths;
  for (int i = 0; i < 100; ++i) {
    depths.push_back(1.0f + static_cast<float>(random() % 40));  // several at one depth
    geometries.push_back(triangle_at(depths.back(), kNonOpaque));
  }
  geometries.push_back(triangle_at(30.5f, kOpaque));
  const uint64_t scene = h.scene(geometries);
  run(h, [&](Invocation& i) {
    RayQuery all;
    RayQuery some;
    trace(i, all, ray_along_z(scene));
    trace(i, some, ray_along_z(scene));
    std::set<uint32_t> seen;
    float committed = 30.5f;
    float last = 0;
    for (uint32_t step = 0; query_proceed(i, all); ++step) {
      EXPECT_TRUE(seen.insert(all.candidate.geometry_index).second);
      EXPECT_GE(all.candidate.t, last);
      last = all.candidate.t;
      EXPECT_TRUE(is_distance(last, depths[all.candidate.geometry_index]));
      if (step % 3 != 0 || !query_proceed(i, some)) continue;
      EXPECT_LT(some.candidate.t, committed);
      if (step == 48) {
        committed = some.candidate.t;
        query_commit_triangle(some);
      }
    }
    size_t expected = 0;
    for (const float depth : depths) expected += depth < 30.5f ? 1 : 0;
    EXPECT_EQ(seen.size(), expected);
    EXPECT_TRUE(is_distance(all.committed.t, 30.5f));
    EXPECT_EQ(some.committed.t, committed);
    EXPECT_LT(committed, 30.5f);
  });
}

TEST(Rq15, BoxesAndTrianglesInOneSceneAreAllShown) {
  Harness h;
  std::vector<GeometryInput> boxes;
  std::vector<GeometryInput> triangles;
  for (int i = 0; i < 20; ++i) {
    boxes.push_back(box_at(static_cast<float>(2 * i + 1)));
    triangles.push_back(triangle_at(static_cast<float>(2 * i + 2), kNonOpaque));
  }
  const uint64_t scene =
      h.top_level({instance_of(h.bottom_level(boxes)), instance_of(h.bottom_level(triangles))});
  run(h, [&](Invocation& i) {
    RayQuery q;
    trace(i, q, ray_along_z(scene));
    std::set<std::pair<uint32_t, uint32_t>> seen;
    while (query_proceed(i, q)) {
      EXPECT_TRUE(seen.insert({q.candidate.instance_index, q.candidate.geometry_index}).second);
    }
    EXPECT_EQ(seen.size(), 40u);
  });
}

TEST(Rq15, AQueryRunsInsideAnAnyHitShader) {
  Harness h;
  h.use_standard_pipeline(run_body_in_any_hit);
  const uint64_t scene = h.scene({triangle_at(2, kNonOpaque), triangle_at(3, kNonOpaque)});
  const uint64_t other = h.scene({triangle_at(4, kOpaque)});
  int calls = 0;
  body() = [&](Invocation& i) {
    RayQuery q;
    trace(i, q, ray_along_z(other));
    EXPECT_FALSE(query_proceed(i, q));
    EXPECT_TRUE(is_distance(q.committed.t, 4.0f));
    ++calls;
  };
  EXPECT_EQ(h.trace(ray_along_z(scene)).end, End::kMiss);
  EXPECT_EQ(calls, 2);
}

TEST(Rq16, NoSceneAndRaysThatAreNoneMiss) {
  Harness h;
  const uint64_t scene = h.scene({triangle_at(2, kOpaque)});
  run(h, [&](Invocation& i) {
    RayQuery q;
    trace(i, q, ray_along_z(0));
    EXPECT_FALSE(query_proceed(i, q));
    EXPECT_EQ(q.committed.type, 0u);
    EXPECT_EQ(q.committed.t, 100.0f);  // RQ-11
    Ray ray = ray_along_z(scene);
    ray.ray.direction[1] = std::numeric_limits<float>::quiet_NaN();
    trace(i, q, ray);
    EXPECT_FALSE(query_proceed(i, q));
    ray = ray_along_z(scene);
    ray.ray.t_min = 2;  // open at both ends
    trace(i, q, ray);
    EXPECT_FALSE(query_proceed(i, q));
    EXPECT_EQ(q.committed.type, 0u);
    trace(i, q, ray_along_z(scene), kRayCullFrontFacingTriangles);
    EXPECT_FALSE(query_proceed(i, q));
    EXPECT_EQ(q.committed.type, 0u);
    trace(i, q, ray_along_z(scene), 0, 0);
    EXPECT_FALSE(query_proceed(i, q));
    EXPECT_EQ(q.committed.type, 0u);
  });
}

}  // namespace
}  // namespace kaamos::embree::testing
