// SPDX-License-Identifier: MIT
//
// One TraceRay in flight. It is on the stack of trace_ray; Embree's callbacks reach it through the
// query context, which is its first member.
#pragma once

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cstdint>

#include "kaamos/shader/abi.h"
#include "runtime/backend/ray_flags.h"
#include "runtime/embree/fault.h"
#include "runtime/embree/instance_node.h"
#include "runtime/embree/top_level.h"
#include "runtime/embree/worker.h"

namespace kaamos::embree {

using runtime::kAllRayFlags;
using runtime::kRayAcceptFirstHitAndEndSearch;
using runtime::kRayCullBackFacingTriangles;
using runtime::kRayCullFrontFacingTriangles;
using runtime::kRayCullNonOpaque;
using runtime::kRayCullOpaque;
using runtime::kRayForceNonOpaque;
using runtime::kRayForceOmm2State;
using runtime::kRayForceOpaque;
using runtime::kRaySkipClosestHitShader;
using runtime::kRaySkipProceduralPrimitives;
using runtime::kRaySkipTriangles;

// Beside a ray's flags: pipeline or RayQuery allow opacity micromaps.
inline constexpr uint32_t kRayAllowsMicromaps = shader::kRayQueryAllowsMicromaps;

inline constexpr uint32_t kHitKindTriangleFrontFace = 254;
inline constexpr uint32_t kHitKindTriangleBackFace = 255;
inline constexpr uint32_t kMaxAttributeBytes = 32;

struct QuerySearch;

struct RayState {
  shim::QueryContext query;  // first: see embree_shim.h
  Worker* worker;
  const TopLevel* top_level;
  const InstanceNode* instance;  // the one being traversed
  const shader::TraceRayArguments* arguments;
  const shader::Invocation* caller;
  void* payload;
  // The values that the shaders of this ray see. `ray` is TraceRay's argument, and so are
  // ray_flags, without the pipeline's flags and undefined bits [DXR: RayFlags]. The rest is set
  // before each shader runs.
  alignas(16) shader::RaySystemValues values;

  uint32_t ray_flags;       // including the pipeline's flags, and kRayAllowsMicromaps
  uint32_t inclusion_mask;  // 8 bits
  const uint8_t* classes;   // GeometryClass bits to visit, by the instance's OpacityOverride
  OpacityOverride opacity;  // from the ray's flags
  QuerySearch* search;      // the RayQuery's; null for TraceRay
  bool ended;               // the search is over: Embree's ray holds kEndedSearch

  float t_min;  // of the DXR interval, at least 0
  float t_max;
  float t_near;  // the open interval of triangles, as Embree's closed one
  float t_far;
  // t of the last hit that a filter or ReportHit committed; Embree commits opaque triangles by
  // itself. A triangle at the same t is outside the open interval. [DXR: Ray extents]
  float committed_t;

  ExactState* exact;  // only if a bottom level of the top level is exact

  shader::InstanceTransform in_cluster;  // world_to_object of `values` for a hit in a cluster

  uint32_t procedural_hit_kind;
  alignas(16) uint8_t procedural_attributes[kMaxAttributeBytes];
};

inline RayInDouble in_double(const shader::RayDesc& ray) {
  return {{ray.origin[0], ray.origin[1], ray.origin[2]},
          {ray.direction[0], ray.direction[1], ray.direction[2]}};
}

inline RayState& ray_state_of(void* context) {
  return *reinterpret_cast<RayState*>(context);
}

// The Invocation for a hit, miss or intersection shader. Copies the caller's, in four 16-byte
// registers, and changes the copy: gcc takes twice as many instructions to build it member by
// member.
inline shader::Invocation invocation_of(const shader::Invocation& caller, const Shader& shader,
                                        const ShaderRecord& record,
                                        const shader::RaySystemValues& values) {
  shader::Invocation invocation = caller;
  invocation.slots = shader.slots;
  invocation.local_arguments = record.local_arguments();
  invocation.ray = &values;
  ++invocation.depth;
  invocation.bound = worker_of(caller).bound[shader.number];
  return invocation;
}

// Sets everything but the ray and its flags, for the shaders of a hit or a candidate.
inline void set_hit_values(const RayState& state, uint32_t instance_index, uint32_t geometry,
                           uint32_t primitive, uint32_t hit_kind, float t_current,
                           shader::RaySystemValues& values) {
  const InstanceNode& instance = state.top_level->nodes()[instance_index];
  values.t_current = t_current;
  values.hit_kind = hit_kind;
  values.instance_index = instance_index;
  values.instance_id = state.top_level->instance_id(instance_index);
  values.geometry_index = geometry;
  values.primitive_index = primitive;
  values.object_to_world = instance.object_to_world;
  values.world_to_object = state.top_level->world_to_object(instance_index);
}

// Puts the application's numbers in the place of Embree's, for a triangle in a cluster.
[[gnu::noinline]] inline void set_cluster_values(RayState& state) {
  shader::RaySystemValues& values = state.values;
  const shader::ClusterTriangle& triangle = state.top_level->cluster_triangle(
      values.instance_index, values.geometry_index, values.primitive_index);
  values.geometry_index = triangle.geometry_index;
  values.primitive_index = triangle.primitive_index;
  state.in_cluster = *reinterpret_cast<const shader::InstanceTransform*>(values.world_to_object);
  state.in_cluster.positions = shader::table_of(&triangle);
  values.world_to_object = state.in_cluster.rows;
}

// The same for the values of the ray's state, from Embree's numbers of geometry and primitive.
inline void set_hit_values(RayState& state, uint32_t instance_index, uint32_t slot,
                           uint32_t primitive, uint32_t hit_kind, float t_current) {
  set_hit_values(state, instance_index, slot, primitive, hit_kind, t_current, state.values);
  if (state.top_level->nodes()[instance_index].clustered) [[unlikely]]
    set_cluster_values(state);
}

// The index of the instance being traversed.
inline uint32_t instance_index(const RayState& state) {
  return static_cast<uint32_t>(state.instance - state.top_level->nodes());
}

// Geometry, instance, ray: each overrides the opacity that the one before it gives. [DXR: TraceRay
// control flow]
inline bool is_opaque(const RayState& state, bool geometry_opaque) {
  OpacityOverride opacity = state.opacity;
  if (opacity == OpacityOverride::kNone) opacity = state.instance->opacity;
  if (opacity == OpacityOverride::kNone) return geometry_opaque;
  return opacity == OpacityOverride::kOpaque;
}

// The same for a triangle that is linked to micromaps, at these barycentrics. Embree's masks do not
// know its opacity, so that what the ray culls by opacity is transparent here.
// [DXR: Opacity micromaps]
inline runtime::Opacity micromap_opacity(const RayState& state, const GeometryInfo& geometry,
                                         uint32_t primitive, float u, float v) {
  using runtime::Opacity;
  const InstanceNode& instance = *state.instance;
  auto found = runtime::MicromapState::kOfGeometry;
  if ((state.ray_flags & kRayAllowsMicromaps) != 0 &&
      (instance.micromap_flags & kNodeDisableMicromaps) == 0) {
    found = geometry.linkage->state_at(primitive, u, v);
  }
  const bool two_states = (instance.micromap_flags & kNodeForceTwoStates) != 0 ||
                          (state.ray_flags & kRayForceOmm2State) != 0;
  Opacity opacity = runtime::opacity_of(found, two_states, geometry.opaque);
  if (opacity == Opacity::kTransparent) return opacity;
  const auto overridden = [](OpacityOverride by, Opacity otherwise) {
    if (by == OpacityOverride::kNone) return otherwise;
    return by == OpacityOverride::kOpaque ? Opacity::kOpaque : Opacity::kNonOpaque;
  };
  opacity = overridden(instance.opacity, opacity);
  const uint32_t culled_by = opacity == Opacity::kOpaque ? kRayCullOpaque : kRayCullNonOpaque;
  if ((state.ray_flags & culled_by) != 0) return Opacity::kTransparent;
  return overridden(state.opacity, opacity);
}

inline ShaderRecord hit_record(const RayState& state, const InstanceNode& instance,
                               uint32_t geometry_index) {
  return state.worker->dispatch->hit_table.at(
      hit_record_index(state.arguments->ray_contribution_to_hit_group_index,
                       state.arguments->multiplier_for_geometry_contribution, geometry_index,
                       instance.contribution));
}

// Front faces are clockwise as seen from the ray's origin, in object space and whatever the
// instance's transform is; in Embree's terms the unnormalised normal points against the ray. [DXR:
// D3D12_RAYTRACING_INSTANCE_FLAGS]
inline uint32_t triangle_hit_kind(const InstanceNode& instance, const float normal[3],
                                  const float object_direction[3]) {
  const float side = normal[0] * object_direction[0] + normal[1] * object_direction[1] +
                     normal[2] * object_direction[2];
  const bool clockwise = side < 0;
  const bool flipped = (instance.flags & kInstanceTriangleFrontCounterclockwise) != 0;
  return clockwise != flipped ? kHitKindTriangleFrontFace : kHitKindTriangleBackFace;
}

// ROBUST scenes accept barycentrics that rounding has moved out of the triangle; shaders get them
// clamped to it. Without branches; NaN becomes 0, because _mm_max_ss returns its second operand if
// the first is NaN.
inline void clamp_barycentrics(float& u, float& v) {
  const auto clamp = [](float x, float limit) {
    return _mm_cvtss_f32(
        _mm_min_ss(_mm_max_ss(_mm_set_ss(x), _mm_setzero_ps()), _mm_set_ss(limit)));
  };
  u = clamp(u, 1);
  v = clamp(v, 1 - u);
}

// Turn the open interval of triangles into Embree's closed one. Denormals are flushed to zero, so
// the smallest t above 0 is FLT_MIN. Without branches: the bits of non-negative floats have the
// same order as the floats. [DXR: Ray extents]
inline float next_above(float t) {
  constexpr auto kBelowSmallest = std::bit_cast<uint32_t>(FLT_MIN) - 1;
  return std::bit_cast<float>(std::max(std::bit_cast<uint32_t>(t), kBelowSmallest) + 1);
}
inline float next_below(float t) {
  const uint32_t below = std::bit_cast<uint32_t>(t) - 1;
  return std::bit_cast<float>(t <= FLT_MIN ? 0u : below);
}

// While it runs, takes a shader's share off the pipeline's stack and names the shader for fault
// messages.
class RunningShader {
 public:
  RunningShader(Worker& worker, const Shader& shader)
      : worker_(worker), caller_(worker.running), left_to_caller_(worker.stack_left) {
    worker.running = &shader;
    if (left_to_caller_ < shader.stack_bytes) [[unlikely]] {
      remove_device(worker, shader::RemovalReason::kStackOverflow);
    }
    worker.stack_left = left_to_caller_ - shader.stack_bytes;
  }
  ~RunningShader() {
    worker_.stack_left = left_to_caller_;
    worker_.running = caller_;
  }
  RunningShader(const RunningShader&) = delete;
  RunningShader& operator=(const RunningShader&) = delete;

 private:
  Worker& worker_;
  const Shader* caller_;
  uint64_t left_to_caller_;
};

}  // namespace kaamos::embree
