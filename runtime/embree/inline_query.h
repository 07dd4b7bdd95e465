// SPDX-License-Identifier: MIT
//
// RayQuery. A query does not suspend Embree between two calls of Proceed: each search is a whole
// traversal that keeps the nearest candidates, in order of (t, instance, geometry, primitive), and
// the next search continues behind them. What a shader sees therefore does not depend on what it
// commits, nor on other queries.
#pragma once

#include "runtime/embree/ray_state.h"

namespace kaamos::embree {

// One traversal. Embree's callbacks reach it through RayState::search.
struct QuerySearch {
  shader::RayQuery& query;
  bool first;  // also looks for opaque triangles
  bool any;    // the first opaque triangle ends it
  // The shader has already seen candidates up to this one; unused in the first search.
  shader::RayQueryFound shown;
  bool has_opaque = false;
  shader::RayQueryFound opaque;  // if `any`

  // For filters: returns whether Embree should commit the hit, which may shorten Embree's ray.
  bool take_triangle(RayState& state, const GeometryInfo& geometry, RTCRay& ray, const RTCHit& hit,
                     bool is_opaque, bool front_face);
  void take_box(const RayState& state, const GeometryInfo& geometry, uint32_t primitive,
                const RTCRay& ray);
  void offer(const shader::RayQueryFound& found);
};

// Services::begin_query and proceed.
void begin_query(shader::Invocation& caller, shader::RayQuery& query,
                 const shader::RayQueryArguments& arguments, const shader::RayDesc& ray);
bool proceed(shader::Invocation& caller, shader::RayQuery& query);

}  // namespace kaamos::embree
