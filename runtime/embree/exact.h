// SPDX-License-Identifier: MIT
//
// TraversalPrecision::kExact: what it keeps for bottom and top levels, and for a ray. Triangles are
// user geometry to Embree, which only finds the candidates. Their boxes are relative to the middle
// of the level and padded by what float arithmetic loses there, and the ray that Embree gets starts
// close to the level, so that the padding is enough wherever the ray comes from. exact_triangle.h
// decides, in double and on the original positions.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "runtime/embree/embree_shim.h"
#include "runtime/embree/exact_pack.h"

namespace kaamos::embree {

// The origin of Embree's coordinates for a level, and how large they get.
struct ExactFrame {
  double center[3] = {0, 0, 0};
  double radius = 0;  // of the box: no |coordinate - center| is larger

  // Covers what float arithmetic does to rays and boxes within 4 radii, in traversals that are not
  // robust: 2^-22 of 8 radii for the reciprocals of the direction, 2^-23 of 4 for the products with
  // the origin, and half of that again for the rounding of the ray.
  double pad() const { return radius * 0x1p-17; }
  // `lower` and `upper` have 3 doubles each. Inverted infinite bounds mean that nothing is inside.
  static ExactFrame of(const double lower[3], const double upper[3]);
  bool holds(const double lower[3], const double upper[3]) const;
  // A box in Embree's coordinates, padded.
  RTCBounds padded(const double lower[3], const double upper[3]) const;
};

// A triangle geometry's own copies of its inputs.
struct ExactTriangles {
  const ExactFrame* frame = nullptr;
  std::vector<float> vertices;
  std::vector<uint32_t> indices;
  std::vector<TrianglePack> packs;  // only triangles that can be hit
  bool attached = false;            // is part of Embree's scene

  const float* corner(uint32_t primitive, int k) const {
    return &vertices[3 * uint64_t{indices[3 * uint64_t{primitive} + k]}];
  }
  // The bounds of a triangle; false if it is never hit because it is degenerate, not finite or
  // outside Embree's range.
  bool bounds(uint32_t primitive, float lower[3], float upper[3]) const;
  // Makes the packs, and extends `lower` and `upper` by the bounds of all triangles in them.
  void pack(RTCDevice device, RTCBuildQuality quality, float lower[3], float upper[3]);
};

// Per instance, for rays.
struct ExactInstance {
  double world_to_object[12];  // 3x4, row-major: the inverse of the float matrix, in double
  const ExactFrame* frame;     // of the bottom level; null: it is not exact
};

struct RayInDouble {
  double origin[3];
  double direction[3];
};

RayInDouble to_object_space(const ExactInstance& instance, const RayInDouble& world);
// The inverse of a matrix that runtime::invert_transform accepted.
void invert_in_double(const float matrix[12], double inverse[12]);

// A ray as Embree gets it in a frame: it starts closer to the frame, and its direction has a length
// of about 1.
struct EmbreeRay {
  double start_t;   // the ray's t at the new start
  double per_unit;  // Embree's t per unit of the ray's t
  float origin[3];
  float direction[3];

  // False: it passes the frame at a distance, or is not a valid ray.
  bool set(const RayInDouble& ray, const ExactFrame& frame);
  // Embree's t, rounded outwards, so that culling by it never removes anything inside the interval.
  float near_of(float t) const;
  float far_of(float t) const;
};

// The part of a ray's state that only exact traversals use.
struct ExactState {
  EmbreeRay in_top_level;  // only if that is a tree
  EmbreeRay in_bottom_level;
  PackFilter filter;
  ExactRay object;  // in the instance being traversed, from the start nearer to it
  double object_start_t;
  // The committed triangle, if the last commit was one; the t is committed_t of the ray's state.
  uint32_t hit_kind;
  uint32_t instance;
  uint32_t geometry;
  uint32_t primitive;
  bool hit_opaque;  // no any-hit shader had to decide
};

struct LaneSearches;
struct RayState;

// Traverse a top level that is a list of boxes, some of them with exact bottom levels.
// [exact_traverse.cpp]
void intersect_exactly(RayState& state, RTCRayHit& ray_hit);
void occlude_exactly(RayState& state, RTCRay& ray);
// The same when it is known which boxes the ray enters.
void intersect_exactly(RayState& state, RTCRayHit& ray_hit, const LaneSearches& lanes, int lane);
void occlude_exactly(RayState& state, RTCRay& ray, const LaneSearches& lanes, int lane);

// Callbacks for Embree.
void bounds_of_exact_pack(const RTCBoundsFunctionArguments* arguments);
void intersect_exact_pack(const RTCIntersectFunctionNArguments* arguments);
void occlude_exact_pack(const RTCOccludedFunctionNArguments* arguments);
void intersect_exact_instance(const RTCIntersectFunctionNArguments* arguments);
void occlude_exact_instance(const RTCOccludedFunctionNArguments* arguments);
void intersect_exact_member(const RTCIntersectFunctionNArguments* arguments);
void occlude_exact_member(const RTCOccludedFunctionNArguments* arguments);

}  // namespace kaamos::embree
