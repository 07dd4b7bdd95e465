// SPDX-License-Identifier: MIT
//
// The data that a traversal needs about an instance, in two cache lines, and the ray transform.
#pragma once

#include <cstdint>

#include "runtime/embree/embree_shim.h"
#include "runtime/embree/simd.h"
#include "runtime/structures/instances.h"

namespace kaamos::embree {

using enum runtime::InstanceFlags;

// The opacity that instance or ray give, overriding the geometry's. [DXR: Ray flags]
enum class OpacityOverride : uint8_t { kNone = 0, kOpaque = 1, kNonOpaque = 2 };

// Mask bits of Embree's geometries, one class each: the culling and skipping flags of a ray become
// bits that Embree tests at no cost.
enum GeometryClass : uint32_t {
  kTriangleOpaque = 1,
  kTriangleNonOpaque = 2,
  kProceduralOpaque = 4,
  kProceduralNonOpaque = 8,
  kTriangleMicromap = 16,  // linked to micromaps: what opacity culls is decided by triangle
  kAllClasses = 31,
};

// The parts of an instance's flags that a node has; the opacity is the rest.
inline constexpr uint32_t kFacingInstanceFlags =
    kInstanceTriangleCullDisable | kInstanceTriangleFrontCounterclockwise;
inline constexpr uint32_t kMicromapInstanceFlagsShift = 4;

enum NodeMicromapFlags : uint32_t {
  kNodeForceTwoStates = kInstanceForceOmm2State >> kMicromapInstanceFlagsShift,
  kNodeDisableMicromaps = kInstanceDisableOmms >> kMicromapInstanceFlagsShift,
};

struct alignas(64) InstanceNode {
  float world_to_object_columns[4][4];  // fourth lanes are 0: there a ray has t and time
  RTCScene scene;                       // null: inactive
  uint32_t contribution : 24;           // InstanceContributionToHitGroupIndex
  uint32_t mask : 8;                    // InstanceMask; 0 also for inactive instances
  uint32_t flags : 2;                   // kFacingInstanceFlags of InstanceFlags
  uint32_t micromap_flags : 2;          // NodeMicromapFlags
  OpacityOverride opacity : 2;          // from the flags
  bool procedural : 1;
  bool exact : 1;      // its bottom level is exact
  bool clustered : 1;  // its bottom level was built from clusters
  float object_to_world[12];
};
static_assert(sizeof(InstanceNode) == 128);

struct ObjectRay {
  __m128 origin;     // fourth lane 0
  __m128 direction;  // fourth lane 0
};

// Applies the linear part of world_to_object; ignores the fourth lane of `v`.
inline __m128 to_object_vector(const InstanceNode& node, __m128 v) {
  const __m128 x = _mm_shuffle_ps(v, v, _MM_SHUFFLE(0, 0, 0, 0));
  const __m128 y = _mm_shuffle_ps(v, v, _MM_SHUFFLE(1, 1, 1, 1));
  const __m128 z = _mm_shuffle_ps(v, v, _MM_SHUFFLE(2, 2, 2, 2));
  const auto& columns = node.world_to_object_columns;
  return _mm_add_ps(
      _mm_add_ps(_mm_mul_ps(_mm_load_ps(columns[0]), x), _mm_mul_ps(_mm_load_ps(columns[1]), y)),
      _mm_mul_ps(_mm_load_ps(columns[2]), z));
}

inline ObjectRay to_object_space(const InstanceNode& node, __m128 origin, __m128 direction) {
  return {_mm_add_ps(to_object_vector(node, origin), _mm_load_ps(node.world_to_object_columns[3])),
          to_object_vector(node, direction)};
}

// `v`, whose fourth lane must be 0, with `lane` as the fourth.
inline __m128 with_fourth_lane(__m128 v, float lane) {
  return _mm_or_ps(v, _mm_castsi128_ps(_mm_slli_si128(_mm_castps_si128(_mm_set_ss(lane)), 12)));
}
inline __m128 without_fourth_lane(__m128 v) {
  return _mm_and_ps(v, _mm_castsi128_ps(_mm_setr_epi32(-1, -1, -1, 0)));
}

// Returns whether Embree may be called with the ray: finite, and below Embree's limit. That
// includes the fourth lanes.
inline bool is_traceable(const ObjectRay& ray) {
  const __m128 absolute = _mm_castsi128_ps(_mm_set1_epi32(0x7FFFFFFF));
  const __m128 limit = _mm_set1_ps(runtime::kLargestCoordinate);
  const __m128 origin_inside = _mm_cmple_ps(_mm_and_ps(ray.origin, absolute), limit);
  const __m128 direction_inside = _mm_cmple_ps(_mm_and_ps(ray.direction, absolute), limit);
  return _mm_movemask_ps(_mm_and_ps(origin_inside, direction_inside)) == 15;
}

}  // namespace kaamos::embree
