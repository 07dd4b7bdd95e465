// SPDX-License-Identifier: MIT
//
// Finds what rays meet in a scene, by brute force in double precision. Knows neither Embree nor
// Vulkan and shares nothing with the product except the API's structures.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/conformance/program.h"

namespace kaamos::conformance {

// The kind of hit group in a geometry's shader record.
enum class GroupKind : uint8_t { kNull, kNoAnyHit, kAnyHit };

// A scene as both the builder of acceleration structures and the reference take it. An instance's
// AccelerationStructure is an index into `bottom_levels`. A geometry's hit record is the instance's
// contribution + the geometry index.
struct Scene {
  std::vector<std::vector<Geometry>> bottom_levels = {};
  std::vector<rtapi::RaytracingInstanceDesc> instances = {};
  std::vector<GroupKind> records = {};
};

// One intersection of a ray with a primitive, inside the ray's interval and not culled. For a box,
// the intersection with the sphere inside it, as traversal.hlsl's Sphere reports it.
struct Candidate {
  uint32_t instance = 0;
  uint32_t geometry = 0;
  uint32_t primitive = 0;
  uint32_t kind = 0;  // HitKind()
  uint32_t record = 0;
  double t = 0;
  double u = 0, v = 0;   // barycentrics of a triangle
  bool commits = false;  // without asking an any-hit shader: opaque, or its group has none
  // False where rounding to float may decide otherwise: near an edge, at the end of the interval,
  // or on a grazing ray.
  bool certain = true;

  uint32_t packed() const { return instance << 24 | geometry << 20 | primitive << 8 | kind; }
};
std::vector<Candidate> candidates(const Scene& scene, const Ray& ray);

// The values of traversal.hlsl's Mode, and its decide().
enum Mode : uint32_t { kIgnoreAll, kAcceptAll, kAcceptSome, kEndSome };
enum Decision : uint32_t { kIgnore, kAccept, kAcceptAndEnd };
Decision decide(uint32_t mode, uint32_t seed, uint32_t packed);

}  // namespace kaamos::conformance
