// SPDX-License-Identifier: MIT
//
// Tests what TraversalPrecision::kExact promises, over scales and distances, compared with what the
// other two precisions do. [DXR: Watertightness; Top-left rule; Ray extents; Degenerate primitives]
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "runtime/embree/testing/closed_mesh.h"
#include "runtime/embree/testing/harness.h"

namespace kaamos::embree::testing {
namespace {

using rtapi::TraversalPrecision;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr const char* kNames[] = {"fast", "robust", "exact"};

GeometryInput geometry_of(const std::vector<Triangle>& mesh, rtapi::RaytracingGeometryFlags flags) {
  GeometryInput input;
  input.flags = flags;
  for (const Triangle& triangle : mesh) {
    for (const Point& p : triangle) input.vertices.push_back({p[0], p[1], p[2]});
  }
  return input;
}

Ray ray_to(uint64_t top_level, const Point& origin, const Point& target) {
  Ray ray = ray_along_z(top_level);
  ray.ray = {{origin[0], origin[1], origin[2]},
             0,
             {target[0] - origin[0], target[1] - origin[1], target[2] - origin[2]},
             kInfinity};
  return ray;
}

enum class Aim { kEdge, kVertex, kInside };

Point aimed_at(const Triangle& triangle, Aim aim, std::mt19937& random) {
  std::uniform_real_distribution<float> unit(0, 1);
  const float u = aim == Aim::kVertex ? 0 : unit(random);
  const float v = aim == Aim::kInside ? (1 - u) * unit(random) : 0;
  Point point;
  for (int k = 0; k < 3; ++k) {
    point[k] = triangle[0][k] + u * (triangle[1][k] - triangle[0][k]) +
               v * (triangle[2][k] - triangle[0][k]);
  }
  return point;
}

struct Placement {
  float scale;   // of the mesh
  float scene;   // how far its instance is from the origin, in x and y
  float camera;  // how far outside the mesh rays start, in mesh sizes; 0: inside
};

// Counts rays with a wrong number of hits: not one from inside, odd from outside.
int wrong_rays(Harness& harness, const Placement& place, Aim aim, int count) {
  const std::vector<Triangle> mesh = closed_mesh(12, place.scale);
  auto instance = instance_of(harness.bottom_level({geometry_of(mesh, kNonOpaque)}));
  instance.Transform[0][3] = place.scene;
  instance.Transform[1][3] = place.scene;
  const uint64_t top_level = harness.top_level({instance});
  std::mt19937 random(static_cast<uint32_t>(aim) + 5);
  std::uniform_real_distribution<float> around(-0.2f, 0.2f);
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    Point target = aimed_at(mesh[random() % mesh.size()], aim, random);
    Point origin = {place.scale * around(random), place.scale * around(random), 0};
    if (place.camera != 0) origin[2] = place.camera * place.scale;
    for (int k = 0; k < 2; ++k) {
      target[k] += place.scene;
      origin[k] += place.scene;
    }
    rays.push_back(ray_to(top_level, origin, target));
  }
  int wrong = 0;
  for (const Payload& payload : harness.trace(rays)) {
    const bool right = place.camera != 0 ? payload.any_hits % 2 == 0 : payload.any_hits == 1;
    wrong += right ? 0 : 1;
  }
  return wrong;
}

// 300,000 rays in exact precision, some of them in the others as well.
TEST(Exact, EveryRayCrossesAClosedMeshOnce) {
  const Placement places[] = {{1e-9f, 0, 0},    {1e-6f, 0, 0},     {1e-3f, 0, 0},   {1, 0, 0},
                              {1e3f, 0, 0},     {1e6f, 0, 0},      {1e9f, 0, 0},    {1e12f, 0, 0},
                              {1, 1e3f, 0},     {100, 1e6f, 0},    {1, 0, 1e3f},    {1, 0, 1e6f},
                              {1e-9f, 0, 1e6f}, {100, 1e6f, 1e3f}, {1e12f, 0, 1e3f}};
  constexpr int kExactRays = 6700;
  constexpr int kOtherRays = 1000;
  int wrong_in_fast = 0;
  std::printf("wrong hits per 1000 rays, at edges / vertices / faces\n%-30s",
              "scale, scene, camera");
  for (const char* name : kNames) std::printf("%22s", name);
  for (const Placement& place : places) {
    std::printf("\n%8.0e %8.0e %8.0e    ", place.scale, place.scene, place.camera);
    for (const int precision : {0, 1, 2}) {
      const bool exact = precision == 2;
      const int count = exact ? kExactRays : kOtherRays;
      double rates[3];
      for (const Aim aim : {Aim::kEdge, Aim::kVertex, Aim::kInside}) {
        Harness harness(1, static_cast<TraversalPrecision>(precision));
        harness.use_standard_pipeline(any_hit_ignore);
        const int wrong = wrong_rays(harness, place, aim, count);
        rates[static_cast<int>(aim)] = 1000.0 * wrong / count;
        if (precision == 0) {
          wrong_in_fast += wrong;
        } else {  // the mesh is not opaque
          EXPECT_EQ(wrong, 0) << "scale " << place.scale << " scene " << place.scene << " camera "
                              << place.camera << " aim " << static_cast<int>(aim);
        }
      }
      std::printf("  %6.1f %6.1f %6.1f", rates[0], rates[1], rates[2]);
    }
  }
  std::printf("\n");
  EXPECT_GT(wrong_in_fast, 0);  // these rays do find errors
}

struct Errors {
  double t;
  double barycentrics;
};

// The largest errors of hits that are not grazing: t in float ulps, barycentrics in units of 2^-24.
Errors largest_errors(TraversalPrecision precision, const Placement& place) {
  Harness harness(1, precision);
  harness.use_standard_pipeline();
  const std::vector<Triangle> mesh = closed_mesh(6, place.scale);
  auto instance = instance_of(harness.bottom_level({geometry_of(mesh, kOpaque)}));
  instance.Transform[0][3] = place.scene;
  const uint64_t top_level = harness.top_level({instance});
  std::mt19937 random(3);
  std::uniform_real_distribution<float> around(-0.5f, 0.5f);
  std::vector<Ray> rays;
  for (int i = 0; i < 2000; ++i) {
    Point target = aimed_at(mesh[random() % mesh.size()], Aim::kInside, random);
    Point origin = {place.scale * around(random), place.scale * around(random),
                    place.scale * place.camera};
    target[0] += place.scene;
    origin[0] += place.scene;
    rays.push_back(ray_to(top_level, origin, target));
  }
  const std::vector<Payload> payloads = harness.trace(rays);
  Errors errors = {0, 0};
  for (size_t i = 0; i < rays.size(); ++i) {
    if (payloads[i].end != End::kClosestHit) continue;
    const Triangle& p = mesh[payloads[i].values.primitive_index];
    const shader::RayDesc& ray = rays[i].ray;
    long double e[3], f[3], s[3], h[3], q[3], d[3];
    for (int k = 0; k < 3; ++k) {
      e[k] = static_cast<long double>(p[1][k]) - p[0][k];
      f[k] = static_cast<long double>(p[2][k]) - p[0][k];
      s[k] = static_cast<long double>(ray.origin[k]) - (k == 0 ? place.scene : 0) - p[0][k];
      d[k] = ray.direction[k];
    }
    for (int k = 0; k < 3; ++k) {
      const int m = (k + 1) % 3, n = (k + 2) % 3;
      h[k] = d[m] * f[n] - d[n] * f[m];
      q[k] = s[m] * e[n] - s[n] * e[m];
    }
    const auto dot = [](const long double* a, const long double* b) {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    const long double det = dot(e, h);
    if (std::fabs(det) < 0.05L * std::sqrt(dot(e, e) * dot(f, f) * dot(d, d))) continue;
    const long double t = dot(f, q) / det;
    const auto nearest = static_cast<float>(std::fabs(t));
    const long double ulp = static_cast<long double>(std::nextafterf(nearest, kInfinity)) - nearest;
    const float u = std::bit_cast<float>(payloads[i].attributes[0]);
    const float v = std::bit_cast<float>(payloads[i].attributes[1]);
    const auto larger = [](double& value, long double error) {
      value = std::max(value, static_cast<double>(std::fabs(error)));
    };
    larger(errors.t, (payloads[i].values.t_current - t) / ulp);
    larger(errors.barycentrics, (u - dot(s, h) / det) * 0x1p24L);
    larger(errors.barycentrics, (v - dot(d, q) / det) * 0x1p24L);
  }
  return errors;
}

TEST(Exact, HitDataIsThatOfLongDouble) {
  const Placement places[] = {{1e-9f, 0, 0.1f}, {1, 0, 0.1f},    {1e12f, 0, 0.1f}, {1, 0, 1e3f},
                              {1, 0, 1e6f},     {1, 1e4f, 0.1f}, {100, 1e6f, 0.1f}};
  std::printf("largest error of t (ulp) / barycentrics (2^-24)\n%-30s", "scale, scene, camera");
  for (const char* name : kNames) std::printf("%24s", name);
  for (const Placement& place : places) {
    std::printf("\n%8.0e %8.0e %8.0e    ", place.scale, place.scene, place.camera);
    for (const int precision : {0, 1, 2}) {
      const Errors errors = largest_errors(static_cast<TraversalPrecision>(precision), place);
      std::printf("  %10.2f / %9.3g", errors.t, errors.barycentrics);
      if (precision != 2) continue;
      EXPECT_LE(errors.t, 0.51);
      EXPECT_LE(errors.barycentrics, 1.01);
    }
  }
  std::printf("\n");
}

// Copies of one triangle: the first by instance, geometry and primitive is the hit.
TEST(Exact, OfCoincidentTrianglesTheFirstIsHit) {
  Harness harness(1, TraversalPrecision::kExact);
  harness.use_standard_pipeline();
  GeometryInput copies = triangle_at(5);
  const std::vector<Vertex> one = copies.vertices;
  for (int i = 0; i < 40; ++i) {
    copies.vertices.insert(copies.vertices.end(), one.begin(), one.end());
  }
  const auto instance = instance_of(harness.bottom_level({copies, copies, copies}));
  const uint64_t top_level = harness.top_level({instance, instance, instance, instance});
  const Payload payload = harness.trace(ray_along_z(top_level, 0.01f, 0.02f));
  ASSERT_EQ(payload.end, End::kClosestHit);
  EXPECT_EQ(payload.values.instance_index, 0u);
  EXPECT_EQ(payload.values.geometry_index, 0u);
  EXPECT_EQ(payload.values.primitive_index, 0u);
  EXPECT_EQ(payload.values.t_current, 5.0f);
}

TEST(Exact, OfCoincidentTrianglesOneIsOfferedToAnAcceptingShader) {
  Harness harness(1, TraversalPrecision::kExact);
  harness.use_standard_pipeline(any_hit_accept);
  const GeometryInput copy = triangle_at(5, kNonOpaque);
  const Payload payload = harness.trace(ray_along_z(harness.scene({copy, copy, copy})));
  EXPECT_EQ(payload.end, End::kClosestHit);
  EXPECT_EQ(payload.any_hits, 1u);
}

TEST(Exact, DegenerateTrianglesAreNeverHit) {
  Harness harness(1, TraversalPrecision::kExact);
  harness.use_standard_pipeline();
  std::mt19937 random(9);
  std::vector<Triangle> lines;
  std::vector<Ray> rays;
  for (int i = 0; i < 200; ++i) {
    const auto coordinate = [&] { return static_cast<float>(random() % 64) - 32; };
    const Point a = {coordinate(), coordinate(), 50 + coordinate()};
    const Point step = {coordinate(), coordinate(), coordinate()};
    const Point b = {a[0] + step[0], a[1] + step[1], a[2] + step[2]};
    const Point c = {a[0] - 2 * step[0], a[1] - 2 * step[1], a[2] - 2 * step[2]};
    lines.push_back({a, b, i % 3 == 0 ? a : c});
  }
  const uint64_t top_level = harness.scene({geometry_of(lines, kOpaque)});
  for (int i = 0; i < 4000; ++i) {
    const Point target = aimed_at(lines[random() % lines.size()], Aim::kEdge, random);
    rays.push_back(ray_to(top_level, {0, 0, -100}, target));
  }
  for (const Payload& payload : harness.trace(rays)) ASSERT_EQ(payload.end, End::kMiss);
}

TEST(Exact, ThreadsDoNotChangeTheResult) {
  std::vector<std::vector<Payload>> results;
  for (const uint32_t threads : {1u, 2u, 7u}) {
    Harness harness(threads, TraversalPrecision::kExact);
    harness.use_standard_pipeline();
    const std::vector<Triangle> mesh = closed_mesh(10, 3);
    auto turned = instance_of(harness.bottom_level({geometry_of(mesh, kOpaque)}));
    auto other = turned;
    other.Transform[0][1] = 0.3f;
    other.Transform[2][3] = 0.5f;
    const uint64_t top_level = harness.top_level({turned, other, turned});
    std::mt19937 random(4);
    std::vector<Ray> rays;
    for (int i = 0; i < 6000; ++i) {
      const Point target = aimed_at(mesh[random() % mesh.size()], static_cast<Aim>(i % 3), random);
      rays.push_back(ray_to(top_level, {0.1f, 0.2f, -20}, target));
    }
    results.push_back(harness.trace(rays));
  }
  for (size_t run = 1; run < results.size(); ++run) {
    for (size_t i = 0; i < results[0].size(); ++i) {
      const Payload& a = results[0][i];
      const Payload& b = results[run][i];
      ASSERT_EQ(a.end, b.end);
      ASSERT_EQ(a.values.t_current, b.values.t_current);
      ASSERT_EQ(a.values.instance_index, b.values.instance_index);
      ASSERT_EQ(a.values.primitive_index, b.values.primitive_index);
      ASSERT_EQ(a.values.hit_kind, b.values.hit_kind);
      ASSERT_EQ(a.attributes[0], b.attributes[0]);
      ASSERT_EQ(a.attributes[1], b.attributes[1]);
    }
  }
}

// In robust precision only bottom levels whose geometry is not all opaque are exact, and a top
// level may have both kinds, and boxes.
TEST(Robust, TopLevelsMixBottomLevelsThatAreExactWithOthers) {
  Harness h(1, TraversalPrecision::kRobust);
  const uint64_t opaque = h.bottom_level({triangle_at(5)});
  const uint64_t box = h.bottom_level({box_at(9)});
  for (const float z : {3.0f, 7.0f}) {
    const uint64_t seen = h.bottom_level({triangle_at(z, kNonOpaque)});
    for (const auto& order :
         {std::vector{opaque, seen, box}, {seen, opaque, box}, {box, seen, opaque}}) {
      std::vector<rtapi::RaytracingInstanceDesc> instances;
      for (const uint64_t level : order) instances.push_back(instance_of(level));
      const auto at = [&](uint64_t level) {
        return static_cast<uint32_t>(std::find(order.begin(), order.end(), level) - order.begin());
      };
      const uint64_t scene = h.top_level(instances);
      report_log() = {};
      h.use_standard_pipeline(any_hit_accept, report_all);
      Payload payload = h.trace(ray_along_z(scene));
      EXPECT_TRUE(
          is_distance(payload.values.t_current, std::min(z, 5.0f), TraversalPrecision::kRobust));
      EXPECT_EQ(payload.values.instance_index, at(z < 5 ? seen : opaque));
      EXPECT_EQ(payload.values.hit_kind, 254u);
      EXPECT_EQ(payload.calls, 1u);
      if (z < 5) {
        EXPECT_EQ(payload.any_hits, 1u);
      }
      auto ray = ray_along_z(scene);
      ray.ray_flags = 0x4 | 0x8;  // visibility
      EXPECT_EQ(h.trace(ray).end, End::kNothing);
      ray.ray_flags = 0x10;  // both triangles are front faces
      EXPECT_EQ(h.trace(ray).values.instance_index, at(z < 5 ? seen : opaque));
      ray.ray_flags = 0x20;
      report_log().reports = {{9.5f, 7, {}}};
      payload = h.trace(ray);
      EXPECT_EQ(payload.values.instance_index, at(box));
      EXPECT_EQ(payload.values.t_current, 9.5f);
      report_log() = {};
      // Up to either triangle, which ends are open.
      ray.ray_flags = 0;
      ray.ray.t_max = std::min(z, 5.0f) - 0.5f;
      EXPECT_EQ(h.trace(ray).end, End::kMiss);
      ray.ray.t_min = 6;
      ray.ray.t_max = 8;
      EXPECT_EQ(h.trace(ray).end, z > 5 ? End::kClosestHit : End::kMiss);

      h.use_standard_pipeline(any_hit_ignore, report_all);
      payload = h.trace(ray_along_z(scene));
      EXPECT_TRUE(is_distance(payload.values.t_current, 5, TraversalPrecision::kRobust));
      EXPECT_EQ(payload.values.instance_index, at(opaque));
      ray = ray_along_z(scene);
      ray.ray_flags = 0x2;  // all triangles are seen
      payload = h.trace(ray);
      EXPECT_EQ(payload.end, End::kMiss);
      EXPECT_EQ(payload.any_hits, 2u);
    }
  }
}

// Surfaces in and around each other, every other one opaque. With `apart`, more instances stand at
// a distance, and the top level is a tree instead of a list.
uint64_t nested_surfaces(Harness& h, bool apart) {
  std::vector<rtapi::RaytracingInstanceDesc> instances;
  for (int i = 0; i < 9; ++i) {
    const auto flags = i % 2 == 0 ? kOpaque : kNonOpaque;
    const std::vector<Triangle> mesh = closed_mesh(4 + i, 0.4f + 0.15f * static_cast<float>(i % 4));
    auto instance = instance_of(h.bottom_level({geometry_of(mesh, flags)}));
    instance.Transform[0][1] = 0.1f * static_cast<float>(i);
    for (int k = 0; k < 3; ++k) {
      instance.Transform[k][3] = 0.37f * static_cast<float>((i * (k + 3)) % 5 - 2);
    }
    instances.push_back(instance);
  }
  for (int i = 0; apart && i < 40; ++i) {
    instances.push_back(instances[i % 2]);
    instances.back().Transform[2][3] = 1e4f + static_cast<float>(i);
  }
  return h.top_level(instances);
}

std::vector<Payload> seen_in(TraversalPrecision precision, bool apart, shader::AnyHitFn any_hit,
                             uint32_t flags) {
  Harness h(1, precision);
  h.use_standard_pipeline(any_hit);
  const uint64_t scene = nested_surfaces(h, apart);
  std::mt19937 random(11);
  std::uniform_real_distribution<float> around(-1.5f, 1.5f);
  std::vector<Ray> rays;
  for (int i = 0; i < 3000; ++i) {
    const Point target = {around(random), around(random), around(random)};
    const float away = i % 3 == 0 ? 1.0f : 8.0f;
    rays.push_back(ray_to(scene, {away * around(random), away * around(random), -away}, target));
    rays.back().ray_flags = flags;
    if (i % 5 == 0) rays.back().ray.t_max = 0.9f;
  }
  return h.trace(rays);
}

// One hit is the nearest of both kinds, however they are found. What is exact is so to the bit.
TEST(Robust, MixedTopLevelsSeeWhatExactOnesSee) {
  constexpr uint32_t kFlags[] = {0, 0x1, 0x4 | 0x8, 0x10, 0x40, 0x80};
  size_t hits = 0;
  for (const auto any_hit : {any_hit_accept, any_hit_ignore}) {
    for (const uint32_t flags : kFlags) {
      const auto wanted = seen_in(TraversalPrecision::kExact, false, any_hit, flags);
      const auto listed = seen_in(TraversalPrecision::kRobust, false, any_hit, flags);
      const auto in_tree = seen_in(TraversalPrecision::kRobust, true, any_hit, flags);
      for (size_t i = 0; i < wanted.size(); ++i) {
        const Payload& want = wanted[i];
        for (const Payload* seen : {&listed[i], &in_tree[i]}) {
          ASSERT_EQ(seen->end, want.end) << "ray " << i << " flags " << flags;
          if (want.end != End::kClosestHit) continue;
          ++hits;
          ASSERT_EQ(seen->values.instance_index, want.values.instance_index);
          ASSERT_EQ(seen->values.hit_kind, want.values.hit_kind);
          ASSERT_NEAR(seen->values.t_current, want.values.t_current, 1e-5f);
          if (want.values.instance_index % 2 == 0) continue;
          ASSERT_EQ(seen->values.t_current, want.values.t_current);
          ASSERT_EQ(seen->values.primitive_index, want.values.primitive_index);
          ASSERT_EQ(seen->attributes[0], want.attributes[0]);
          ASSERT_EQ(seen->attributes[1], want.attributes[1]);
        }
        ASSERT_EQ(listed[i].values.t_current, in_tree[i].values.t_current);
      }
    }
  }
  EXPECT_GT(hits, 10000u);
}

// The edges of a quad, where the default precision runs any-hit shaders: because the geometry, the
// instance or the ray says so.
TEST(Robust, SharedEdgesAreHitOnceByAnyHitShaders) {
  Harness h(1, TraversalPrecision::kRobust);
  h.use_standard_pipeline(any_hit_ignore);
  GeometryInput quad;
  quad.vertices = {{-1, -1, 5}, {1, -1, 5}, {1, 1, 5}, {-1, 1, 5}};
  quad.indices = {0, 2, 1, 0, 3, 2};
  quad.flags = kNonOpaque;
  GeometryInput opaque = quad;
  opaque.flags = kOpaque;
  const uint64_t level = h.bottom_level({opaque});
  std::vector<rtapi::RaytracingInstanceDesc> many(50, instance_of(level));
  for (size_t i = 1; i < many.size(); ++i) many[i].Transform[0][3] = 10 * static_cast<float>(i);
  constexpr uint32_t kForceNonOpaque = 8;
  struct Case {
    uint64_t scene;
    uint32_t ray_flags;
  };
  for (const Case& each : {Case{h.scene({quad}), 0}, Case{h.scene({opaque}, kForceNonOpaque), 0},
                           Case{h.scene({opaque}), 0x2}, Case{h.top_level(many), 0x2}}) {
    std::vector<Ray> rays;
    for (int i = -200; i <= 200; ++i) {
      const float at = 0.8f * static_cast<float>(i) / 200;
      for (const float start : {0.0f, 0.37f, -2.1f}) {
        Ray ray = ray_along_z(each.scene, start, -0.5f * start);
        ray.ray.direction[0] = at - start;
        ray.ray.direction[1] = at + 0.5f * start;
        ray.ray.direction[2] = 5;
        ray.ray_flags = each.ray_flags;
        rays.push_back(ray);
      }
    }
    uint32_t wrong = 0;
    for (const Payload& payload : h.trace(rays)) wrong += payload.any_hits == 1 ? 0 : 1;
    EXPECT_EQ(wrong, 0u) << each.ray_flags;
  }
}

// The exact levels that rays ask for are made once, by whichever thread comes first.
TEST(Robust, ManyThreadsMayAskForNonOpaqueTriangles) {
  Harness h(6, TraversalPrecision::kRobust);
  h.use_standard_pipeline(any_hit_ignore);
  const std::vector<Triangle> mesh = closed_mesh(12, 1);
  const uint64_t level = h.bottom_level({geometry_of(mesh, kOpaque)});
  for (int run = 0; run < 8; ++run) {
    const uint64_t scene = h.top_level({instance_of(level), instance_of(level)});
    std::mt19937 random(6);
    std::vector<Ray> rays;
    for (int i = 0; i < 5000; ++i) {
      const Point target = aimed_at(mesh[random() % mesh.size()], static_cast<Aim>(i % 3), random);
      rays.push_back(ray_to(scene, {0.1f, 0.05f, 0}, target));
      rays.back().ray_flags = 0x2;
    }
    uint32_t wrong = 0;
    for (const Payload& payload : h.trace(rays)) wrong += payload.any_hits == 2 ? 0 : 1;
    EXPECT_EQ(wrong, 0u);
  }
}

}  // namespace
}  // namespace kaamos::embree::testing
