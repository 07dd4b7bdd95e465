// SPDX-License-Identifier: MIT
//
// Bottom levels of clusters as rays meet them: rules CLS-10, 13, 15, 35 to 38 and 43 to 45, without
// the operations that decode clusters.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "kaamos/shader/ray_query.h"
#include "kaamos/shader/triangle_positions.h"
#include "runtime/embree/device.h"
#include "runtime/embree/parallel.h"
#include "runtime/embree/ray_state.h"
#include "runtime/embree/testing/harness.h"

namespace kaamos::embree::testing {
namespace {

using runtime::ClusteredGeometry;
constexpr auto kDataAccess = runtime::BuildFlags::kAllowDataAccess;

// What the next shader finds out about a hit beside the payload's values.
struct Seen {
  uint32_t cluster = 0;
  float corner[3] = {};  // the triangle's first one
};
Seen seen;
std::vector<uint32_t> any_hit_clusters;

Seen seen_by(const shader::Invocation& invocation) {
  const shader::RaySystemValues& ray = *invocation.ray;
  const shader::uint2 table = shader::position_table(ray.world_to_object);
  const auto positions = shader::triangle_positions(table, ray.geometry_index, ray.primitive_index);
  return {shader::cluster_id(table), {positions[0][0], positions[0][1], positions[0][2]}};
}
void look_closely(shader::Invocation& invocation, void* payload, const void* attributes) {
  closest_hit(invocation, payload, attributes);
  seen = seen_by(invocation);
}
shader::AnyHitResult note_cluster(shader::Invocation& invocation, void* payload, const void* at) {
  any_hit_clusters.push_back(seen_by(invocation).cluster);
  return any_hit_ignore(invocation, payload, at);
}

// Triangles that a ray along +z hits at (0, 0, z), one for each z, with numbers from `first` on.
ClusteredGeometry stack_of(uint32_t geometry, rtapi::RaytracingGeometryFlags flags,
                           const std::vector<float>& zs, uint32_t cluster, uint32_t first = 0) {
  ClusteredGeometry result;
  result.geometry_index = geometry;
  result.flags = flags;
  for (const float z : zs) {
    for (const Vertex& v : triangle_at(z).vertices) {
      result.indices.push_back(static_cast<uint32_t>(result.xyz.size() / 3));
      result.xyz.insert(result.xyz.end(), {v.x, v.y, v.z});
    }
    result.primitive_index.push_back(first++);
    result.cluster_id.push_back(cluster);
  }
  return result;
}

// Returns the address of a bottom level.
uint64_t place(Harness& h, const std::vector<ClusteredGeometry>& geometries) {
  auto& device = static_cast<Device&>(h.device());
  runtime::AccelerationStructure structure;
  const auto memory = h.buffer(4096);
  structure.address = memory->address();
  structure.host = memory->host();
  structure.size_bytes = 4096;
  structure.flags = kDataAccess;
  run_in_arena(device.arena(), [&] {
    auto level = BottomLevel::build_clustered(device.build_context(), geometries, kDataAccess);
    EXPECT_TRUE(level.ok());
    if (level) structure.bottom_level = *level;
  });
  const uint64_t address = structure.address;
  device.memory().place(std::move(structure));
  return address;
}

void use_pipeline(Harness& h, shader::AnyHitFn any = nullptr) {
  PipelineBuilder builder;
  const auto ray_generation = builder.ray_generation(trace_job);
  const auto hits = builder.hit_group(look_closely, any);
  const auto misses = builder.miss(miss);
  h.set_pipeline(builder, ray_generation);
  std::vector<Record> records;
  for (uint32_t i = 0; i < 64; ++i) records.push_back({hits, i});
  h.set_hit_table(records);
  h.set_miss_table({{misses, 1000}});
}

TEST(Cls35, RecordsFollowSparseGeometryIndices) {
  Harness h;
  auto instance =
      instance_of(place(h, {stack_of(9, kOpaque, {5}, 70, 4), stack_of(3, kOpaque, {4, 3}, 71),
                            stack_of(16777215, kOpaque, {2}, 72, 200)}));
  instance.InstanceContributionToHitGroupIndex = 7;
  const uint64_t scene = h.top_level({instance});
  use_pipeline(h);
  Ray ray = ray_along_z(scene);
  ray.ray_contribution_to_hit_group_index = 1;
  ray.ray.t_min = 4.5f;
  ray.multiplier_for_geometry_contribution = 2;
  Payload found = h.trace(ray);
  EXPECT_EQ(found.record, 7u + 1 + 2 * 9);
  EXPECT_EQ(found.values.geometry_index, 9u);
  EXPECT_EQ(found.values.primitive_index, 4u);
  EXPECT_EQ(seen.cluster, 70u);
  EXPECT_EQ(seen.corner[2], 5.0f);
  ray.ray.t_min = 2.5f;
  found = h.trace(ray);
  EXPECT_EQ(found.record, 7u + 1 + 2 * 3);
  EXPECT_EQ(found.values.primitive_index, 1u);
  EXPECT_EQ(seen.cluster, 71u);
  EXPECT_EQ(seen.corner[2], 3.0f);
  ray.ray.t_min = 0;
  ray.multiplier_for_geometry_contribution = 0;
  found = h.trace(ray);
  EXPECT_EQ(found.record, 7u + 1);
  EXPECT_EQ(found.values.geometry_index, 16777215u);
  EXPECT_EQ(found.values.primitive_index, 200u);
  EXPECT_EQ(seen.cluster, 72u);
}

TEST(Cls37, TrianglesOfOneGeometryIndexHaveFlagsOfTheirOwn) {
  Harness h;
  const uint64_t scene = h.top_level(
      {instance_of(place(h, {stack_of(5, kNonOpaque, {1, 3}, 40), stack_of(5, kOpaque, {2}, 41, 2),
                             stack_of(6, kOpaque, {9}, 42)}))});
  use_pipeline(h, note_cluster);
  any_hit_clusters.clear();
  const Payload found = h.trace(ray_along_z(scene));
  EXPECT_TRUE(is_distance(found.values.t_current, 2.0f));
  EXPECT_EQ(found.values.geometry_index, 5u);
  EXPECT_EQ(found.values.primitive_index, 2u);
  EXPECT_EQ(seen.cluster, 41u);
  EXPECT_EQ(any_hit_clusters.front(), 40u);
  Ray culled = ray_along_z(scene);
  culled.ray_flags = kRayCullOpaque;
  any_hit_clusters.clear();
  EXPECT_EQ(h.trace(culled).end, End::kMiss);
  EXPECT_EQ(any_hit_clusters, (std::vector<uint32_t>{40, 40}));
  culled.ray_flags = kRayForceNonOpaque;
  any_hit_clusters.clear();
  EXPECT_EQ(h.trace(culled).end, End::kMiss);
  std::sort(any_hit_clusters.begin(), any_hit_clusters.end());
  EXPECT_EQ(any_hit_clusters, (std::vector<uint32_t>{40, 40, 41, 42}));
}

TEST(Cls43, OtherBottomLevelsHaveNoCluster) {
  Harness h;
  const uint64_t classic = h.bottom_level({triangle_at(2)}, kDataAccess);
  auto far = instance_of(place(h, {stack_of(0, kOpaque, {5}, 8)}));
  const uint64_t scene = h.top_level({instance_of(classic), far});
  use_pipeline(h);
  Ray ray = ray_along_z(scene);
  h.trace(ray);
  EXPECT_EQ(seen.cluster, shader::kNoCluster);
  EXPECT_EQ(seen.corner[2], 2.0f);
  ray.ray.t_min = 3;
  h.trace(ray);
  EXPECT_EQ(seen.cluster, 8u);
  EXPECT_EQ(seen.corner[2], 5.0f);
}

std::function<void(shader::Invocation&)> ray_generation_body;
void run_ray_generation_body(shader::Invocation& invocation) {
  ray_generation_body(invocation);
}
void run_once(Harness& h, std::function<void(shader::Invocation&)> shader) {
  ray_generation_body = std::move(shader);
  PipelineBuilder builder;
  const auto ray_generation = builder.ray_generation(run_ray_generation_body);
  const auto hits = builder.hit_group(look_closely, nullptr);
  const auto misses = builder.miss(miss);
  h.set_pipeline(builder, ray_generation);
  h.set_hit_table(std::vector<Record>(32, {hits, 0}));
  h.set_miss_table({{misses, 1000}});
  const uint32_t root = 0;
  ASSERT_TRUE(h.dispatch(1, 1, 1, &root, sizeof(root)));
}

TEST(Cls44, QueriesKnowClustersOfCandidatesAndHits) {
  Harness h;
  const uint64_t scene = h.top_level({instance_of(
      place(h, {stack_of(5, kNonOpaque, {1, 3}, 40, 7), stack_of(5, kOpaque, {4}, 41)}))});
  run_once(h, [&](shader::Invocation& invocation) {
    shader::Descriptor view;
    view.kind = shader::DescriptorKind::kAccelerationStructure;
    view.address = scene;
    shader::RayQuery query;
    shader::begin_query(invocation, query, view, 0, 0xFF, ray_along_z(scene).ray);
    std::vector<uint32_t> primitives;
    while (query_proceed(invocation, query)) {
      EXPECT_EQ(shader::cluster_id(shader::query_position_table(query.candidate)), 40u);
      EXPECT_EQ(query.candidate.geometry_index, 5u);
      primitives.push_back(query.candidate.primitive_index);
    }
    EXPECT_EQ(primitives, (std::vector<uint32_t>{7, 8}));
    EXPECT_EQ(shader::cluster_id(shader::query_position_table(query.committed)), 41u);
    EXPECT_EQ(query.committed.geometry_index, 5u);
    EXPECT_EQ(query.committed.primitive_index, 0u);
    shader::begin_query(invocation, query, view, kRaySkipTriangles, 0xFF, ray_along_z(scene).ray);
    EXPECT_FALSE(query_proceed(invocation, query));
    EXPECT_EQ(shader::cluster_id(shader::query_position_table(query.committed)),
              shader::kNoCluster);
  });
}

TEST(Cls45, HitObjectsKeepTheirCluster) {
  Harness h;
  const uint64_t scene = h.top_level({instance_of(place(h, {stack_of(3, kOpaque, {4}, 77, 11)}))});
  run_once(h, [&](shader::Invocation& invocation) {
    Payload payload;
    const Ray ray = ray_along_z(scene);
    shader::HitObject hit;
    const shader::Services& services = *invocation.dispatch->services;
    services.trace_hit_object(invocation, ray, &payload, origin_t_min(ray.ray),
                              direction_t_max(ray.ray), hit);
    EXPECT_EQ(hit.geometry_index, 3u);
    EXPECT_EQ(hit.primitive_index, 11u);
    EXPECT_EQ(shader::cluster_id(shader::as_words(shader::position_table_of(hit))), 77u);
    services.invoke_hit_object(invocation, hit, &payload, sizeof(payload));
    EXPECT_EQ(seen.cluster, 77u);
    EXPECT_EQ(payload.values.primitive_index, 11u);
    EXPECT_EQ(seen.corner[2], 4.0f);
  });
}

// The same triangles as a classic bottom level and as clusters of 17.
TEST(Cls15, HitsAreThoseOfTheSameTrianglesWithoutClusters) {
  Harness h;
  constexpr uint32_t kTriangles = 1000;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place_in(-1, 1);
  GeometryInput classic;
  classic.flags = kOpaque;
  ClusteredGeometry clustered[2];
  for (uint32_t g = 0; g < 2; ++g) clustered[g] = stack_of(4 * g, kOpaque, {}, 0);
  for (uint32_t i = 0; i < kTriangles; ++i) {
    const Vertex middle = {place_in(random), place_in(random), 2 + place_in(random)};
    ClusteredGeometry& out = clustered[i % 2];
    for (int corner = 0; corner < 3; ++corner) {
      const Vertex v = {middle.x + 0.2f * place_in(random), middle.y + 0.2f * place_in(random),
                        middle.z + 0.2f * place_in(random)};
      classic.vertices.push_back(v);
      out.indices.push_back(static_cast<uint32_t>(out.xyz.size() / 3));
      out.xyz.insert(out.xyz.end(), {v.x, v.y, v.z});
    }
    out.primitive_index.push_back(i % 17);
    out.cluster_id.push_back(i / 17);
  }
  const uint64_t scenes[2] = {h.scene({classic}),
                              h.top_level({instance_of(place(h, {clustered[0], clustered[1]}))})};
  use_pipeline(h);
  uint32_t hits = 0;
  for (int i = 0; i < 2000; ++i) {
    Ray ray = ray_along_z(scenes[0], place_in(random), place_in(random));
    ray.ray.direction[0] = 0.3f * place_in(random);
    const Payload without = h.trace(ray);
    ray.acceleration_structure = scenes[1];
    const Payload with = h.trace(ray);
    ASSERT_EQ(with.end, without.end);
    if (with.end != End::kClosestHit) continue;
    ++hits;
    ASSERT_EQ(with.values.t_current, without.values.t_current);
    ASSERT_EQ(with.attributes[0], without.attributes[0]);
    ASSERT_EQ(with.attributes[1], without.attributes[1]);
    ASSERT_EQ(with.values.hit_kind, without.values.hit_kind);
    const uint32_t triangle = without.values.primitive_index;
    ASSERT_EQ(with.values.geometry_index, 4 * (triangle % 2));
    ASSERT_EQ(with.values.primitive_index, triangle % 17);
    ASSERT_EQ(seen.cluster, triangle / 17);
    ASSERT_EQ(seen.corner[0], classic.vertices[3 * size_t{triangle}].x);
  }
  EXPECT_GT(hits, 500u);
}

TEST(Cls32, WithoutTrianglesNothingIsHit) {
  Harness h;
  const uint64_t scene = h.top_level({instance_of(place(h, {}))});
  use_pipeline(h);
  EXPECT_EQ(h.trace(ray_along_z(scene)).end, End::kMiss);
}

}  // namespace
}  // namespace kaamos::embree::testing
