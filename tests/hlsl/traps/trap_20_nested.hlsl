// SPDX-License-Identifier: MIT
// TRAP: 20
// OPTIONS: -enable-16bit-types
// EXPECT u32 0 254
// EXPECT u32 4 1
// EXPECT u32 8 1
// EXPECT u32 12 7
// EXPECT f32 16 5 2
// EXPECT f32 20 0.5 2
// EXPECT f32 24 5
// EXPECT u32 32 254
// EXPECT u32 36 0
// EXPECT u32 40 1
// EXPECT f32 44 8 2
// EXPECT u32 60 1
// EXPECT u32 64 1
// EXPECT u32 68 0
// EXPECT f32 72 13 2
// After a shader has traced another ray, its system values are still those of its own ray; a payload
// with bools survives every trace. Distances and barycentrics allow for Embree's reciprocal (2 ulps).
RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer results : register(u0);

struct Inner {
  bool3 flags;
  float16_t h;
};
struct Payload {
  Inner inner[2];
  bool nested;
  float t;
};

[shader("miss")]
void Miss(inout Payload payload) { payload.t = -1; }

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes a) {
  payload.t = RayTCurrent();
  payload.inner[1].flags = bool3(true, !payload.inner[1].flags.y, payload.inner[0].flags.x);
  if (payload.nested) {
    results.Store4(32, uint4(HitKind(), PrimitiveIndex(), GeometryIndex(), asuint(payload.t)));
    return;
  }
  // From behind the first triangle to the next one.
  Payload other = (Payload)0;
  other.nested = true;
  RayDesc ray = {WorldRayOrigin() + WorldRayDirection() * RayTCurrent(), 0.001, float3(0, 0, 1),
                 100};
  TraceRay(scene, RAY_FLAG_NONE, 0x0f, 0, 0, 0, ray, other);
  results.Store4(0, uint4(HitKind(), PrimitiveIndex(), GeometryIndex(), InstanceID()));
  results.Store4(16, asuint(float4(RayTCurrent(), a.barycentrics.x, ObjectToWorld3x4()[2][3], 0)));
  results.Store(60, other.inner[1].flags.x && other.inner[1].flags.y && !other.inner[1].flags.z);
  results.Store3(64, uint3(payload.inner[1].flags.z, payload.nested,
                           asuint(payload.t + other.t)));
}

[shader("raygeneration")]
void Main() {
  Payload payload = (Payload)0;
  payload.inner[0].flags.x = true;
  RayDesc ray = {float3(-3, 2, 0), 0, float3(0, 0, 1), 100};
  TraceRay(scene, RAY_FLAG_NONE, 0x0f, 0, 0, 0, ray, payload);
}
