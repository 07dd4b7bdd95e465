// SPDX-License-Identifier: MIT
//
// Results are the same for any number of threads; statistics; and any rays and matrices at all.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "runtime/embree/ray_state.h"
#include "runtime/embree/testing/harness.h"

namespace kaamos::embree {
namespace {

using testing::End;
using testing::GeometryInput;
using testing::Harness;
using testing::Payload;

class Random {
 public:
  explicit Random(uint32_t seed) : state_(seed) {}
  uint32_t bits() {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<uint32_t>(state_ >> 32);
  }
  float unit() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }
  float symmetric() { return 2 * unit() - 1; }
  // Any float at all: numbers of every magnitude, NaN, infinities, denormals.
  float anything() {
    switch (bits() % 8) {
      case 0:
        return std::bit_cast<float>(bits());
      case 1:
        return 0;
      case 2:
        return symmetric() * 1e18f;
      case 3:
        return symmetric() * 1e-30f;
      case 4:
        return std::numeric_limits<float>::infinity();
      case 5:
        return std::numeric_limits<float>::quiet_NaN();
      default:
        return symmetric();
    }
  }

 private:
  uint64_t state_;
};

GeometryInput soup(Random& random, uint32_t triangles, rtapi::RaytracingGeometryFlags flags) {
  GeometryInput input;
  input.flags = flags;
  for (uint32_t i = 0; i < triangles; ++i) {
    const float x = 2 * random.symmetric();
    const float y = 2 * random.symmetric();
    const float z = 2 * random.symmetric();
    for (int corner = 0; corner < 3; ++corner) {
      input.vertices.push_back({x + 0.3f * random.symmetric(), y + 0.3f * random.symmetric(),
                                z + 0.3f * random.symmetric()});
    }
  }
  return input;
}

uint64_t random_scene(Harness& h, Random& random) {
  const uint64_t mixed =
      h.bottom_level({soup(random, 300, testing::kOpaque), soup(random, 300, testing::kNonOpaque)});
  GeometryInput boxes;
  for (int i = 0; i < 40; ++i) {
    const float x = 2 * random.symmetric();
    const float y = 2 * random.symmetric();
    const float z = 2 * random.symmetric();
    boxes.boxes.push_back({x, y, z, x + 0.2f, y + 0.2f, z + 0.2f});
  }
  const uint64_t procedural = h.bottom_level({boxes});
  std::vector<rtapi::RaytracingInstanceDesc> instances;
  for (uint32_t i = 0; i < 12; ++i) {
    auto instance = testing::instance_of(i % 4 == 3 ? procedural : mixed);
    for (auto& row : instance.Transform) {
      for (float& value : row) value += 0.5f * random.symmetric();
    }
    instance.Flags = i % 3 == 1 ? uint32_t{kInstanceForceNonOpaque} : 0;
    instances.push_back(instance);
  }
  return h.top_level(instances);
}

void report_by_index(shader::Invocation& invocation) {
  const float t = 1 + 0.25f * static_cast<float>(invocation.ray->primitive_index);
  invocation.dispatch->services->report_hit(invocation, t, 3, nullptr, 0);
}

std::vector<Payload> render(uint32_t threads) {
  Harness h(threads);
  Random random(42);
  const uint64_t scene = random_scene(h, random);
  // Accepts every other primitive.
  h.use_standard_pipeline(
      [](shader::Invocation& invocation, void* payload, const void* attributes) {
        testing::any_hit_accept(invocation, payload, attributes);
        return invocation.ray->primitive_index % 2 == 0 ? shader::AnyHitResult::kIgnore
                                                        : shader::AnyHitResult::kAccept;
      },
      report_by_index);
  std::vector<testing::Ray> rays;
  for (uint32_t i = 0; i < 20000; ++i) {
    auto ray = testing::ray_along_z(scene);
    ray.ray = {{4 * random.symmetric(), 4 * random.symmetric(), -6},
               0,
               {0.3f * random.symmetric(), 0.3f * random.symmetric(), 1},
               100};
    const uint32_t flags[5] = {kRayAcceptFirstHitAndEndSearch, kRayCullBackFacingTriangles};
    ray.ray_flags = flags[i % 5];
    rays.push_back(ray);
  }
  auto payloads = h.trace(rays);
  for (Payload& payload : payloads) {  // addresses and padding differ
    shader::RaySystemValues& values = payload.values;
    values.object_to_world = values.world_to_object = nullptr;
    constexpr size_t kEnd = offsetof(shader::RaySystemValues, primitive_index) + sizeof(uint32_t);
    constexpr size_t kNext = offsetof(shader::RaySystemValues, object_to_world);
    std::memset(reinterpret_cast<uint8_t*>(&values) + kEnd, 0, kNext - kEnd);
  }
  return payloads;
}

TEST(Dispatch, TheSameBitsForAnyNumberOfThreads) {
  const auto one = render(1);
  size_t hits = 0;
  for (const Payload& payload : one) hits += payload.end == End::kClosestHit;
  EXPECT_GT(hits, one.size() / 10);
  EXPECT_LT(hits, one.size());
  for (const uint32_t threads : {2u, 7u, 1u}) {
    const auto other = render(threads);
    ASSERT_EQ(one.size(), other.size());
    EXPECT_EQ(std::memcmp(one.data(), other.data(), one.size() * sizeof(Payload)), 0) << threads;
  }
}

TEST(Dispatch, StatisticsCountWhatRan) {
  Harness h(2);
  h.use_standard_pipeline(testing::any_hit_ignore);
  const uint64_t scene =
      h.scene({testing::triangle_at(3, testing::kNonOpaque), testing::triangle_at(5)});
  std::vector<testing::Ray> rays(100, testing::ray_along_z(scene));
  for (int i = 0; i < 30; ++i) rays[i].ray.origin[0] = 50;
  for (int i = 90; i < 100; ++i) {
    rays[i].ray_flags = kRayAcceptFirstHitAndEndSearch | kRaySkipClosestHitShader;
  }
  h.trace(rays);
  const auto statistics = h.device().statistics();
  EXPECT_EQ(statistics.TraceRayCalls, 100u);
  EXPECT_EQ(statistics.VisibilityRays, 10u);
  EXPECT_EQ(statistics.Hits, 70u);
  EXPECT_EQ(statistics.Misses, 30u);
  EXPECT_EQ(statistics.ClosestHitInvocations, 60u);
  EXPECT_EQ(statistics.MissInvocations, 30u);
  // A visibility ray may reach the opaque triangle first.
  EXPECT_GE(statistics.AnyHitInvocations, 60u);
  EXPECT_LE(statistics.AnyHitInvocations, 70u);
  h.device().reset_statistics();
  EXPECT_EQ(h.device().statistics().TraceRayCalls, 0u);
}

TEST(Guards, NoRayStopsTheProcess) {
  Harness h(2);
  Random random(7);
  const uint64_t scene = random_scene(h, random);
  h.use_standard_pipeline(testing::any_hit_accept, report_by_index);
  std::vector<testing::Ray> rays;
  for (int i = 0; i < 50000; ++i) {
    auto ray = testing::ray_along_z(scene);
    float* values[] = {&ray.ray.origin[0],    &ray.ray.origin[1],    &ray.ray.origin[2],
                       &ray.ray.direction[0], &ray.ray.direction[1], &ray.ray.direction[2],
                       &ray.ray.t_min,        &ray.ray.t_max};
    for (float* value : values) {
      if (random.bits() % 4 == 0) *value = random.anything();
    }
    ray.ray_flags = random.bits();
    ray.instance_inclusion_mask = random.bits();
    ray.miss_shader_index = random.bits() % 16;
    ray.ray_contribution_to_hit_group_index = random.bits();
    ray.multiplier_for_geometry_contribution = random.bits();
    rays.push_back(ray);
  }
  for (const Payload& payload : h.trace(rays)) {
    if (payload.end != End::kClosestHit) continue;
    EXPECT_GE(payload.values.t_current, payload.values.ray.t_min);
    EXPECT_LE(payload.values.t_current, payload.values.ray.t_max);
  }
}

TEST(Guards, NoMatrixStopsTheProcess) {
  Harness h(2);
  Random random(8);
  const uint64_t level = h.bottom_level({soup(random, 50, testing::kNonOpaque)});
  h.use_standard_pipeline(testing::any_hit_accept);
  for (int round = 0; round < 40; ++round) {
    std::vector<rtapi::RaytracingInstanceDesc> instances(30, testing::instance_of(level));
    for (auto& instance : instances) {
      const uint32_t kind = random.bits() % 3;
      for (auto& row : instance.Transform) {
        for (float& value : row) {
          if (kind == 0) value = random.anything();
          if (kind == 1 && random.bits() % 3 == 0) value = 0;
          if (kind == 2) value = random.symmetric() * std::exp2f(80 * random.symmetric());
        }
      }
    }
    const uint64_t scene = h.top_level(instances);
    ASSERT_NE(scene, 0u);
    std::vector<testing::Ray> rays;
    for (int i = 0; i < 300; ++i) {
      auto ray = testing::ray_along_z(scene, 3 * random.symmetric(), 3 * random.symmetric());
      ray.ray.origin[2] = -5;
      if (i % 3 == 0) ray.ray.origin[0] *= 1e17f;
      ray.ray.t_max = std::numeric_limits<float>::infinity();
      rays.push_back(ray);
    }
    h.trace(rays);
  }
}

TEST(Guards, NoVertexStopsABuildOrAnUpdate) {
  Harness h;
  Random random(9);
  h.use_standard_pipeline();
  using Flags = rtapi::RaytracingAccelerationStructureBuildFlags;
  for (uint32_t round = 0; round < 60; ++round) {
    GeometryInput input = soup(random, 20, testing::kOpaque);
    GeometryInput other = soup(random, 20, testing::kOpaque);
    for (GeometryInput* each : {&input, &other}) {
      for (auto& v : each->vertices) {
        if (random.bits() % 3 == 0) v = {random.anything(), random.anything(), random.anything()};
      }
    }
    const auto flags =
        static_cast<Flags>((round % 2) | (round % 5 == 0 ? 8u : 0u) | (round % 7 == 0 ? 16u : 0u));
    auto command = h.bottom_level_command({input}, flags);
    ASSERT_TRUE(h.execute(command).ok());
    const uint64_t scene = h.top_level({testing::instance_of(command.dest)});
    h.trace(testing::ray_along_z(scene));
    if (round % 2 == 0) continue;
    command.geometries = {h.geometry(other)};
    command.flags = flags | Flags::kPerformUpdate;
    command.source = command.dest;
    ASSERT_TRUE(h.execute(command).ok());
    h.trace(testing::ray_along_z(h.top_level({testing::instance_of(command.dest)})));
  }
}

}  // namespace
}  // namespace kaamos::embree
