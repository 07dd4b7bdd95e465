// SPDX-License-Identifier: MIT
// Rays from a buffer, and each value of what they hit. ray_probe.h has the same layouts.

struct ProbeRay {
  float3 origin;
  float t_min;
  float3 direction;
  float t_max;
};

struct ProbeHit {
  float t;  // -1: no hit
  float2 barycentrics;
  uint primitive;
};

struct Payload {
  ProbeHit hit;
};

RaytracingAccelerationStructure scene : register(t0);
StructuredBuffer<ProbeRay> rays : register(t1);
RWStructuredBuffer<ProbeHit> hits : register(u0);

RayDesc DescOf(ProbeRay ray) {
  RayDesc desc;
  desc.Origin = ray.origin;
  desc.TMin = ray.t_min;
  desc.Direction = ray.direction;
  desc.TMax = ray.t_max;
  return desc;
}

[shader("raygeneration")]
void ProbeRays() {
  const uint index = DispatchRaysIndex().x;
  Payload payload = (Payload)0;
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 0, 0, DescOf(rays[index]), payload);
  hits[index] = payload.hit;
}

// Counts and ignores every triangle that the ray meets.
[shader("raygeneration")]
void CountTriangles() {
  const uint index = DispatchRaysIndex().x;
  Payload payload = (Payload)0;
  TraceRay(scene, RAY_FLAG_FORCE_NON_OPAQUE, 0xFF, 1, 0, 0, DescOf(rays[index]), payload);
  hits[index] = payload.hit;
}

[shader("anyhit")]
void CountAnyHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes attributes) {
  payload.hit.primitive += 1;
  IgnoreHit();
}

[shader("closesthit")]
void ProbeClosestHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes attributes) {
  payload.hit.t = RayTCurrent();
  payload.hit.barycentrics = attributes.barycentrics;
  payload.hit.primitive = PrimitiveIndex();
}

[shader("miss")]
void ProbeMiss(inout Payload payload) {
  payload.hit.t = -1.0;
}
