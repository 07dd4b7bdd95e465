// SPDX-License-Identifier: MIT
// Shaders for the messages of checked mode's layer; they make no mistakes themselves.

RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer results : register(u0);
ByteAddressBuffer local_data : register(t0, space1);
cbuffer LocalConstants : register(b0, space1) { uint ordinal; }

struct Payload { uint value; };

RayDesc straight() {
  RayDesc ray;
  ray.Origin = float3(0.1, 0.2, -1.0);
  ray.Direction = float3(0.0, 0.0, 1.0);
  ray.TMin = 0.0;
  ray.TMax = 100.0;
  return ray;
}

[shader("raygeneration")]
void RayGen() {
  Payload payload = { 0 };
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0, straight(), payload);
  results.Store(0, payload.value);
}

// Two ray types.
[shader("raygeneration")]
void RayGenTwo() {
  Payload payload = { 0 };
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 1, 2, 1, straight(), payload);
  results.Store(0, payload.value);
}

[shader("raygeneration")]
void RayGenCall() {
  Payload payload = { 0 };
  CallShader(2, payload);
  results.Store(0, payload.value);
}

[shader("closesthit")]
void Hit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  payload.value = 1;
}

[shader("closesthit")]
void HitLocal(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  payload.value = local_data.Load(0) + ordinal;
}

struct BoxAttributes { float2 unused; };

[shader("intersection")]
void Intersect() {
  BoxAttributes attributes = { float2(0.0, 0.0) };
  ReportHit(1.0, 0, attributes);
}

[shader("miss")]
void Miss(inout Payload payload) {
  payload.value = 2;
}

[shader("callable")]
void Call(inout Payload payload) {
  payload.value = 3;
}

ByteAddressBuffer source : register(t1);

[shader("compute")]
[numthreads(1, 1, 1)]
void CopyBytes() {
  results.Store4(0, source.Load4(0));
}

// Overwrites what is bound to u0, by a number that no identifier of a process's first shaders holds.
[shader("raygeneration")]
void RayGenWrites() {
  Payload payload = { 0 };
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0, straight(), payload);
  results.Store(4, payload.value + 0xFFFF0005u);
}

RWTexture2D<float> picture : register(u1);
Texture2D<float> seen : register(t2);

[shader("compute")]
[numthreads(1, 1, 1)]
void Paint() {
  picture[uint2(0, 0)] = 1.0;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void Look() {
  results.Store(0, asuint(seen.Load(int3(0, 0, 0))));
}
