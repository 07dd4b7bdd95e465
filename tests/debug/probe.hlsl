// SPDX-License-Identifier: MIT
// The debugger test stops in here, in an any-hit shader below a ray generation shader.

RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer results : register(u0);

struct Payload {
  float transmittance;
  uint layers;
  float2 seen;  // in memory wherever the debugger stops
};

static const float kOpacity = 0.25;

void Attenuate(inout Payload payload, float2 barycentrics) {
  const float2 where = barycentrics;
  const float thickness = 1.0 + where.x;
  payload.transmittance *= 1.0 - kOpacity * thickness;  // BREAK HERE
  payload.layers += 1;
}

[shader("raygeneration")]
void ProbeRayGen() {
  RayDesc ray;
  ray.Origin = float3(0.25, 0.25, -1.0);
  ray.TMin = 0.0;
  ray.Direction = float3(0, 0, 1);
  ray.TMax = 10.0;
  Payload payload;
  payload.transmittance = 1.0;
  payload.layers = 0;
  payload.seen = float2(0, 0);
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0, ray, payload);  // CALLED FROM HERE
  results.Store(0, asuint(payload.transmittance));
  results.Store(4, payload.layers);
}

[shader("anyhit")]
void ProbeAnyHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  payload.seen = hit.barycentrics;
  Attenuate(payload, hit.barycentrics);
  IgnoreHit();
}

[shader("miss")]
void ProbeMiss(inout Payload payload) {
}
