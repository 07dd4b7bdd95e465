// SPDX-License-Identifier: MIT
// The debugger test stops in here without a breakpoint: a function of the any-hit shader asks for
// it.

RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer results : register(u0);

struct [raypayload] Payload {
  float debugged : read(caller) : write(caller);
  uint layers : read(caller, anyhit) : write(caller, anyhit);
};

void Count(inout Payload payload) {
  payload.layers += 1;
  if (payload.layers == 2) DebugBreak();  // BREAK HERE
}

[shader("raygeneration")]
void ProbeRayGen() {
  RayDesc ray;
  ray.Origin = float3(0.25, 0.25, -1.0);
  ray.TMin = 0.0;
  ray.Direction = float3(0, 0, 1);
  ray.TMax = 10.0;
  Payload payload;
  payload.debugged = dx::IsDebuggingEnabled() ? 1.0 : 0.5;
  payload.layers = 0;
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0, ray, payload);
  results.Store(0, asuint(payload.debugged));
  results.Store(4, payload.layers);
}

[shader("anyhit")]
void ProbeAnyHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  Count(payload);
  IgnoreHit();
}

[shader("miss")]
void ProbeMiss(inout Payload payload) {
}
