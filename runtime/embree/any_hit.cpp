// SPDX-License-Identifier: MIT
//
// Triangles that Embree may not commit by itself: facing culls, opacity, any-hit shaders. The tests
// come in DXR's order [DXR: TraceRay control flow].
#include "runtime/embree/any_hit.h"

#include "runtime/embree/inline_query.h"

namespace kaamos::embree {
namespace {

struct TriangleFilter {
  RayState& state;
  const GeometryInfo& geometry;
  RTCRay& ray;  // in object space; tfar is the candidate's t
  RTCHit& hit;

  bool is_culled(uint32_t hit_kind) const {
    if ((state.instance->flags & kInstanceTriangleCullDisable) != 0) return false;
    const uint32_t culled_by = hit_kind == kHitKindTriangleBackFace ? kRayCullBackFacingTriangles
                                                                    : kRayCullFrontFacingTriangles;
    return (state.ray_flags & culled_by) != 0;
  }

  // Records the hit that Embree commits when the filter returns.
  void commit(bool end_search) {
    state.committed_t = ray.tfar;
    if (end_search || (state.ray_flags & kRayAcceptFirstHitAndEndSearch) != 0) {
      state.ended = true;
      ray.tfar = shim::kEndedSearch;
    }
  }

  bool accept() {
    // The interval is open at the committed hit: of coincident triangles the first one wins.
    if (state.ended || ray.tfar >= state.committed_t) return false;
    const float normal[3] = {hit.Ng_x, hit.Ng_y, hit.Ng_z};
    const uint32_t hit_kind = triangle_hit_kind(*state.instance, normal, &ray.dir_x);
    if (is_culled(hit_kind)) return false;
    bool opaque = false;
    if (geometry.linkage == nullptr) {
      opaque = is_opaque(state, geometry.opaque);
    } else {
      const auto found = micromap_opacity(state, geometry, hit.primID, hit.u, hit.v);
      if (found == runtime::Opacity::kTransparent) return false;
      opaque = found == runtime::Opacity::kOpaque;
    }
    if (state.search != nullptr) {
      return state.search->take_triangle(state, geometry, ray, hit, opaque,
                                         hit_kind == kHitKindTriangleFrontFace);
    }
    if (opaque) return commit(false), true;
    const ShaderRecord record = hit_record(state, *state.instance, geometry.index);
    // Without an any-hit shader the geometry is opaque. [DXR: TraceRay control flow, note 3]
    if (!record.target->any_hit.runs()) return commit(false), true;

    float barycentrics[2] = {hit.u, hit.v};
    clamp_barycentrics(barycentrics[0], barycentrics[1]);
    const Candidate candidate = {ray.tfar, hit_kind, geometry.slot, hit.primID, barycentrics};
    const auto result = run_any_hit(state, record, candidate);
    if (result == shader::AnyHitResult::kIgnore) return false;
    commit(result == shader::AnyHitResult::kAcceptAndEndSearch);
    return true;
  }
};

}  // namespace

shader::AnyHitResult run_any_hit(RayState& state, const ShaderRecord& record,
                                 const Candidate& candidate) {
  Worker& worker = *state.worker;
  const Shader& shader = record.target->any_hit;
  ++worker.counters.any_hit_calls;
  set_hit_values(state, instance_index(state), candidate.geometry, candidate.primitive,
                 candidate.hit_kind, candidate.t);
  shader::Invocation invocation = invocation_of(*state.caller, shader, record, state.values);
  const RunningShader running(worker, shader);
  return shader.as<shader::AnyHitFn>()(invocation, state.payload, candidate.attributes);
}

namespace {

void filter(const RTCFilterFunctionNArguments* arguments, RayState& state) {
  TriangleFilter triangle = {state, *static_cast<const GeometryInfo*>(arguments->geometryUserPtr),
                             *reinterpret_cast<RTCRay*>(arguments->ray),
                             *reinterpret_cast<RTCHit*>(arguments->hit)};
  if (!triangle.accept()) arguments->valid[0] = 0;
}

}  // namespace

void filter_triangle(const RTCFilterFunctionNArguments* arguments) {
  RayState& state = ray_state_of(arguments->context);
  // Embree will call the query's filter next.
  if (shim::has_all_hits_filter(state.query)) return;
  filter(arguments, state);
}

void filter_every_triangle(const RTCFilterFunctionNArguments* arguments) {
  filter(arguments, ray_state_of(arguments->context));
}

}  // namespace kaamos::embree
