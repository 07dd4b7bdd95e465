// SPDX-License-Identifier: MIT
//
// The one place that knows which Embree is in use: 3.13 (Debian 12) or 4.x (newer systems). CMake
// defines KAAMOS_EMBREE_MAJOR. Both are used in the same way: a filter on each non-opaque geometry,
// and a second filter that a query may enable for every geometry.
#pragma once

#include <cstdint>
#include <limits>

#if KAAMOS_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace kaamos::embree::shim {

// The per-ray state that Embree passes to every callback. It must be the first member of the ray's
// own state, which the callbacks get by a cast; that works in 3.x and 4.x, and through instances.
struct QueryContext {
#if KAAMOS_EMBREE_MAJOR >= 4
  RTCRayQueryContext base;
  RTCFilterFunctionN all_hits_filter;
#else
  RTCIntersectContext base;
#endif
};

#if KAAMOS_EMBREE_MAJOR >= 4

inline constexpr RTCSceneFlags kSceneFlagQueryFilter = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

inline void init(QueryContext& query) {
  rtcInitRayQueryContext(&query.base);
  query.all_hits_filter = nullptr;
}

// A filter that sees the hits of all geometries, or null.
inline void set_all_hits_filter(QueryContext& query, RTCFilterFunctionN filter) {
  query.all_hits_filter = filter;
}
inline bool has_all_hits_filter(const QueryContext& query) {
  return query.all_hits_filter != nullptr;
}

inline void intersect(RTCScene scene, QueryContext& query, RTCRayHit* ray_hit) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &query.base;
  arguments.filter = query.all_hits_filter;
  if (query.all_hits_filter != nullptr) {
    arguments.flags =
        static_cast<RTCRayQueryFlags>(arguments.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
  }
  rtcIntersect1(scene, ray_hit, &arguments);
}

inline void occluded(RTCScene scene, QueryContext& query, RTCRay* ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &query.base;
  arguments.filter = query.all_hits_filter;
  if (query.all_hits_filter != nullptr) {
    arguments.flags =
        static_cast<RTCRayQueryFlags>(arguments.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
  }
  rtcOccluded1(scene, ray, &arguments);
}

// 4.x reads from the mask whether a user geometry was hit.
template <typename Arguments>
void set_hit(const Arguments* arguments, bool hit) {
  arguments->valid[0] = hit ? -1 : 0;
}

#else

inline constexpr RTCSceneFlags kSceneFlagQueryFilter = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

inline void init(QueryContext& query) {
  rtcInitIntersectContext(&query.base);
}

// A filter that sees the hits of all geometries, or null.
inline void set_all_hits_filter(QueryContext& query, RTCFilterFunctionN filter) {
  query.base.filter = filter;
}
inline bool has_all_hits_filter(const QueryContext& query) {
  return query.base.filter != nullptr;
}

inline void intersect(RTCScene scene, QueryContext& query, RTCRayHit* ray_hit) {
  rtcIntersect1(scene, &query.base, ray_hit);
}

inline void occluded(RTCScene scene, QueryContext& query, RTCRay* ray) {
  rtcOccluded1(scene, &query.base, ray);
}

template <typename Arguments>
void set_hit(const Arguments*, bool) {}

#endif

// Sets the instance that the hits of a nested query belong to.
inline void set_instance(QueryContext& query, uint32_t instance) {
  query.base.instID[0] = instance;
}

inline constexpr float kEndedSearch = -std::numeric_limits<float>::infinity();

}  // namespace kaamos::embree::shim
