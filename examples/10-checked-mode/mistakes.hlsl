// SPDX-License-Identifier: MIT
// One ray: a hit gives the number in the record, a miss 0. All mistakes are in main.cpp.

RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer results : register(u0);
cbuffer Record : register(b0, space1) { uint number; }

struct Payload {
  uint number;
};

[shader("raygeneration")]
void RayGen() {
  RayDesc ray;
  ray.Origin = float3(0, 0, -1);
  ray.TMin = 0.0;
  ray.Direction = float3(0, 0, 1);
  ray.TMax = 10.0;
  Payload payload = { 0 };
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0, ray, payload);
  results.Store(0, payload.number);
}

[shader("miss")]
void Miss(inout Payload payload) { payload.number = 0; }

[shader("closesthit")]
void ClosestHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes attributes) {
  payload.number = number;
}
