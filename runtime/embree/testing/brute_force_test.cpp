// SPDX-License-Identifier: MIT
//
// TRV-11, TRV-15, TRV-66: compares hits with a reference in double precision that tests every
// triangle of every instance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/embree/instance_boxes.h"
#include "runtime/embree/testing/harness.h"

namespace kaamos::embree::testing {
namespace {

class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  float symmetric() {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<float>(state_ >> 40) * 0x1p-23f - 1.0f;
  }

 private:
  uint64_t state_;
};

struct Double3 {
  double x, y, z;
};
Double3 operator-(const Double3& a, const Double3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
double dot(const Double3& a, const Double3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Double3 cross(const Double3& a, const Double3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct Reference {
  uint32_t hits = 0;
  double closest = 1e300;
  uint32_t primitive = 0;
  uint32_t instance = 0;
  bool front = false;      // in world space, for a matrix that does not mirror
  bool uncertain = false;  // passes an edge or an end of the ray within rounding
};

struct Scene {
  std::vector<Vertex> vertices;
  std::vector<rtapi::RaytracingInstanceDesc> instances;
};

void test_triangle(const shader::RayDesc& ray, const Double3 corners[3], uint32_t instance,
                   uint32_t primitive, Reference& reference) {
  const Double3 origin = {ray.origin[0], ray.origin[1], ray.origin[2]};
  const Double3 direction = {ray.direction[0], ray.direction[1], ray.direction[2]};
  const Double3 e1 = corners[1] - corners[0];
  const Double3 e2 = corners[2] - corners[0];
  const Double3 p = cross(direction, e2);
  const double determinant = dot(e1, p);
  const double scale = std::sqrt(dot(e1, e1) * dot(e2, e2) * dot(direction, direction));
  if (std::abs(determinant) < 1e-4 * scale) {
    reference.uncertain = true;
    return;
  }
  const Double3 s = origin - corners[0];
  const double u = dot(s, p) / determinant;
  const Double3 q = cross(s, e1);
  const double v = dot(direction, q) / determinant;
  const double t = dot(e2, q) / determinant;
  constexpr double kEdge = 1e-4;
  if (u < -kEdge || v < -kEdge || u + v > 1 + kEdge) return;
  if (t < ray.t_min - kEdge || t > ray.t_max + kEdge) return;
  if (u < kEdge || v < kEdge || u + v > 1 - kEdge || t < ray.t_min + kEdge ||
      t > ray.t_max - kEdge) {
    reference.uncertain = true;
    return;
  }
  ++reference.hits;
  if (std::abs(t - reference.closest) < kEdge) reference.uncertain = true;
  if (t >= reference.closest) return;
  reference.closest = t;
  reference.primitive = primitive;
  reference.instance = instance;
  reference.front = dot(cross(e1, e2), direction) < 0;
}

Reference trace_reference(const Scene& scene, const shader::RayDesc& ray) {
  Reference reference;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const auto& m = scene.instances[i].Transform;
    for (uint32_t triangle = 0; triangle < scene.vertices.size() / 3; ++triangle) {
      Double3 corners[3];
      for (int c = 0; c < 3; ++c) {
        const Vertex& v = scene.vertices[3 * triangle + c];
        double xyz[3];
        for (int row = 0; row < 3; ++row) {
          xyz[row] = double{m[row][0]} * v.x + double{m[row][1]} * v.y + double{m[row][2]} * v.z +
                     m[row][3];
        }
        corners[c] = {xyz[0], xyz[1], xyz[2]};
      }
      test_triangle(ray, corners, i, triangle, reference);
    }
  }
  return reference;
}

// 360 triangles, divided among the instances.
Scene random_scene(Random& random, uint32_t instances) {
  Scene scene;
  for (uint32_t i = 0; i < 360 / instances; ++i) {
    const float center[3] = {random.symmetric(), random.symmetric(), random.symmetric()};
    for (int corner = 0; corner < 3; ++corner) {
      scene.vertices.push_back({center[0] + 0.6f * random.symmetric(),
                                center[1] + 0.6f * random.symmetric(),
                                center[2] + 0.6f * random.symmetric()});
    }
  }
  for (uint32_t i = 0; i < instances; ++i) {
    auto instance = instance_of(0);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        instance.Transform[row][column] += (column == 3 ? 1.5f : 0.3f) * random.symmetric();
      }
    }
    scene.instances.push_back(instance);
  }
  return scene;
}

void compare(rtapi::RaytracingGeometryFlags flags, shader::AnyHitFn any_hit, uint64_t seed,
             uint32_t instances) {
  Harness h(2);
  Random random(seed);
  Scene scene = random_scene(random, instances);
  GeometryInput input;
  input.vertices = scene.vertices;
  input.flags = flags;
  const uint64_t level = h.bottom_level({input});
  for (auto& instance : scene.instances) instance.AccelerationStructure = level;
  const uint64_t top_level = h.top_level(scene.instances);
  h.use_standard_pipeline(any_hit);
  std::vector<Ray> rays;
  for (int i = 0; i < 1500; ++i) {
    auto ray = ray_along_z(top_level);
    ray.ray = {{3 * random.symmetric(), 3 * random.symmetric(), 3 * random.symmetric()},
               0.1f,
               {random.symmetric(), random.symmetric(), random.symmetric()},
               3 + 2 * random.symmetric()};
    rays.push_back(ray);
  }
  const auto payloads = h.trace(rays);
  uint32_t compared = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    const Reference reference = trace_reference(scene, rays[i].ray);
    if (reference.uncertain) continue;
    ++compared;
    const Payload& payload = payloads[i];
    if (any_hit == any_hit_ignore) {
      EXPECT_EQ(payload.end, End::kMiss) << i;
      EXPECT_EQ(payload.any_hits, reference.hits) << i;
      continue;
    }
    ASSERT_EQ(payload.end, reference.hits != 0 ? End::kClosestHit : End::kMiss) << i;
    if (reference.hits == 0) continue;
    EXPECT_NEAR(payload.values.t_current, reference.closest, 1e-4) << i;
    EXPECT_EQ(payload.values.primitive_index, reference.primitive) << i;
    EXPECT_EQ(payload.values.instance_index, reference.instance) << i;
    EXPECT_EQ(payload.values.hit_kind, reference.front ? 254u : 255u) << i;
  }
  EXPECT_GT(compared, rays.size() / 2);
}

TEST(Trv11, ClosestHitsAreThoseOfTheReference) {
  compare(kOpaque, nullptr, 1, 6);
  compare(kOpaque, nullptr, 2, 6);
}
TEST(Trv11, ClosestHitsInAsManyInstancesAsAListOfBoxesHolds) {
  compare(kOpaque, nullptr, 5, kMostInstanceBoxes);
}
TEST(Trv11, ClosestHitsInMoreInstances) {
  compare(kOpaque, nullptr, 6, kMostInstanceBoxes + 1);
}
TEST(Trv11, AcceptedAnyHitsEndAtTheSameHit) {
  compare(kNonOpaque, any_hit_accept, 3, 6);
}
TEST(Trv15, IgnoredHitsAreAllThereIs) {
  compare(kNonOpaque, any_hit_ignore, 4, 6);
  compare(kNonOpaque, any_hit_ignore, 7, kMostInstanceBoxes + 1);
}

TEST(Trv66, DegenerateTrianglesMayBecomeValidByAnUpdate) {
  using Flags = rtapi::RaytracingAccelerationStructureBuildFlags;
  Harness h;
  h.use_standard_pipeline();
  GeometryInput collapsed = triangle_at(3);
  for (Vertex& v : collapsed.vertices) v = {0, 0, 3};
  for (const Vertex& v : triangle_at(7).vertices) collapsed.vertices.push_back(v);
  auto command = h.bottom_level_command({collapsed}, Flags::kAllowUpdate);
  ASSERT_TRUE(h.execute(command).ok());
  const auto depth = [&] {
    return h.trace(ray_along_z(h.top_level({instance_of(command.dest)}))).values.t_current;
  };
  EXPECT_TRUE(is_distance(depth(), 7.0f));
  command.flags = command.flags | Flags::kPerformUpdate;
  command.source = command.dest;
  GeometryInput restored = collapsed;
  std::copy_n(triangle_at(3).vertices.begin(), 3, restored.vertices.begin());
  command.geometries = {h.geometry(restored)};
  ASSERT_TRUE(h.execute(command).ok());
  EXPECT_TRUE(is_distance(depth(), 3.0f));
  command.geometries = {h.geometry(collapsed)};
  ASSERT_TRUE(h.execute(command).ok());
  EXPECT_TRUE(is_distance(depth(), 7.0f));
}

}  // namespace
}  // namespace kaamos::embree::testing
