// SPDX-License-Identifier: MIT
// FEATURE: extended RayQuery that a function returns
// EXPECT f32 0 7 4
// EXPECT f32 4 6.5 4
// EXPECT u32 8 1
// EXPECT u32 12 1
// EXPECT u32 16 3
#include "scene.hlsli"

typedef RayQuery<RAY_FLAG_FORCE_OPAQUE> Query;

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {}

Query traced(RayDesc ray) {
  Query query;
  query.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, ray);
  if (ray.TMax < 0) return query;
  query.Proceed();
  return query;
}

// A template whose name hides a built-in function's.
template <typename Q>
Q TraceRay(RayDesc ray) {
  Q query;
  query.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, ray);
  query.Proceed();
  return query;
}

// The caller's object.
Query same(Query query) { return query; }

Query through(RayDesc ray) { return traced(ray); }

struct Tracer {
  RayDesc ray;
  Query trace() { return through(ray); }
};

[shader("raygeneration")]
void Main() {
  RayDesc ray = test_ray(-10);
  Query first = traced(ray);
  const float t = first.CommittedRayT();
  ray.Origin.z += 0.5;
  // Two objects, though one function made them.
  Query second = TraceRay<Query>(ray);
  results.Store(0, asuint(first.CommittedRayT()));
  results.Store(4, asuint(second.CommittedRayT()));
  Tracer tracer = {ray};
  results.Store(8, uint(tracer.trace().CommittedRayT() == t - 0.5));
  Query again = same(first);
  again.TraceRayInline(scene, RAY_FLAG_NONE, 0, ray);
  again.Proceed();
  results.Store(12, uint(first.CommittedStatus() == COMMITTED_NOTHING));
  uint hits = 0;
  for (uint i = 0; i < 3; ++i) hits += traced(ray).CommittedStatus();
  results.Store(16, hits);
}
