// SPDX-License-Identifier: MIT
//
// RayQuery. A query does not hold Embree still between two calls of Proceed: each search is a whole
// traversal that keeps the nearest candidates, in order of (t, instance, geometry, primitive), and
// the next one goes on behind them. What a shader sees therefore does not depend on what it
// commits, nor on other queries.
#pragma once

#include "runtime/embree/ray_state.h"

namespace kaamos::embree {

// One traversal. Embree's callbacks reach it through RayState::search.
struct QuerySearch {
  shader::RayQuery& query;
  bool first;  // looks for opaque triangles, too
  bool any;    // the first opaque triangle ends it
  // Candidates up to this one were shown before; not in the first search.
  shader::RayQueryFound shown;
  bool has_opaque = false;
  shader::RayQueryFound opaque;  // of `any`

  // What a filter is asked: whether Embree commits the hit, which may shorten its ray.
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
