// SPDX-License-Identifier: MIT
//
// Hits in exact precision have the same bits on every processor: their hash is compared with the
// one that all processors had when it was written down. Embree finds the candidates, with
// instructions that differ between processors, and the test of exact_triangle.h decides.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <random>

#include "runtime/embree/testing/harness.h"

namespace kaamos::embree::testing {
namespace {

// Any number from -1 to 1 in steps of 2^-23.
float next_number(std::mt19937& random) {
  return static_cast<float>(static_cast<int32_t>(random() >> 8) - (1 << 23)) * 0x1p-23f;
}

// A bumpy sheet of triangles that share their vertices, in a turned and stretched space.
GeometryInput sheet(std::mt19937& random) {
  constexpr uint32_t kEdge = 40;
  GeometryInput input;
  input.flags = kOpaque;
  for (uint32_t y = 0; y <= kEdge; ++y) {
    for (uint32_t x = 0; x <= kEdge; ++x) {
      input.vertices.push_back({static_cast<float>(x) * 0.05f - 1,
                                static_cast<float>(y) * 0.05f - 1, 0.2f * next_number(random)});
    }
  }
  for (uint32_t y = 0; y < kEdge; ++y) {
    for (uint32_t x = 0; x < kEdge; ++x) {
      const uint32_t corner = y * (kEdge + 1) + x;
      for (const uint32_t i : {0u, 1u, kEdge + 1, kEdge + 1, 1u, kEdge + 2}) {
        input.indices.push_back(corner + i);
      }
    }
  }
  return input;
}

uint64_t hash_of(const std::vector<Payload>& payloads) {
  uint64_t hash = 0xCBF29CE484222325u;
  const auto add = [&](uint32_t word) { hash = (hash ^ word) * 0x100000001B3u; };
  for (const Payload& payload : payloads) {
    add(static_cast<uint32_t>(payload.end));
    if (payload.end != End::kClosestHit) continue;
    add(payload.values.instance_index);
    add(payload.values.primitive_index);
    add(payload.values.hit_kind);
    add(std::bit_cast<uint32_t>(payload.values.t_current));
    add(payload.attributes[0]);
    add(payload.attributes[1]);
  }
  return hash;
}

TEST(SameBits, HitsInExactPrecision) {
  Harness harness(1, rtapi::TraversalPrecision::kExact);
  harness.use_standard_pipeline();
  std::mt19937 random(11);
  const GeometryInput mesh = sheet(random);
  std::vector<rtapi::RaytracingInstanceDesc> instances;
  for (int i = 0; i < 3; ++i) {
    auto instance = instance_of(harness.bottom_level({mesh}));
    for (auto& row : instance.Transform) {
      for (float& value : row) value += 0.3f * next_number(random);
    }
    instances.push_back(instance);
  }
  const uint64_t top_level = harness.top_level(instances);
  std::vector<Ray> rays;
  for (int i = 0; i < 50000; ++i) {
    Ray ray = ray_along_z(top_level);
    ray.ray.t_max = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      ray.ray.origin[axis] = 3 * next_number(random);
      // Half of them at vertices of the mesh, as it would be without its transform.
      const Vertex& vertex = mesh.vertices[random() % mesh.vertices.size()];
      const float target[3] = {vertex.x, vertex.y, vertex.z};
      ray.ray.direction[axis] =
          (i % 2 == 0 ? target[axis] : next_number(random)) - ray.ray.origin[axis];
    }
    rays.push_back(ray);
  }
  const std::vector<Payload> payloads = harness.trace(rays);
  const auto hits = std::count_if(payloads.begin(), payloads.end(),
                                  [](const Payload& p) { return p.end == End::kClosestHit; });
  EXPECT_GT(hits, 20000);
  EXPECT_EQ(hash_of(payloads), 0xe580f131171d3a2au);
}

}  // namespace
}  // namespace kaamos::embree::testing
