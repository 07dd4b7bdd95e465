// SPDX-License-Identifier: MIT
// Closest-hit shaders that trace again.
#include "standard.hlsl"

// Traces on from behind the hit with other flags; notes its own flags before and after, and the
// inner ray's flags.
[shader("closesthit")]
void NestedFlags(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  const uint before = RayFlags();
  RayDesc ray;
  ray.Origin = WorldRayOrigin() + (RayTCurrent() + 1) * WorldRayDirection();
  ray.TMin = 0;
  ray.Direction = WorldRayDirection();
  ray.TMax = 1000;
  Seen inner = nothingSeen();
  TraceRay(scene, RAY_FLAG_FORCE_OPAQUE | RAY_FLAG_CULL_BACK_FACING_TRIANGLES, 0xFF, 1, 0, 0, ray,
           inner);
  seen.end = 1;
  seen.flags = before;
  seen.anyRecord = inner.flags;
  seen.geometry = RayFlags();
}

// Notes its own hit only after the nested trace has found another one.
[shader("closesthit")]
void NestedValues(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  RayDesc ray;
  ray.Origin = WorldRayOrigin() + (RayTCurrent() + 1) * WorldRayDirection();
  ray.TMin = 0;
  ray.Direction = WorldRayDirection();
  ray.TMax = 1000;
  Seen inner = nothingSeen();
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 1, 0, 0, ray, inner);
  noteHit(seen);
  seen.barycentrics = attributes.barycentrics;
  seen.anyRecord = inner.primitive;
  seen.anyHits = inner.end;
}
