// SPDX-License-Identifier: MIT
// A hit object that is traced, read, and invoked; and one that is made.

RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer words : register(u0);

cbuffer Record : register(b0, space1) {
  uint number;
};

struct Payload {
  uint hits;
  uint misses;
};

RayDesc forward(float x) {
  RayDesc ray;
  ray.Origin = float3(x, 0, 0);
  ray.TMin = 0;
  ray.Direction = float3(0, 0, 1);
  ray.TMax = 100;
  return ray;
}

[shader("raygeneration")]
void Generate() {
  const uint i = DispatchRaysIndex().x;
  Payload payload;
  payload.hits = payload.misses = 0;
  const RayDesc ray = forward(i * 10.0);
  dx::HitObject hit = dx::HitObject::TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0, ray, payload);
  dx::MaybeReorderThread(hit);
  dx::HitObject::Invoke(hit, payload);
  dx::HitObject made = dx::HitObject::MakeMiss(RAY_FLAG_NONE, 1, ray);
  dx::HitObject::Invoke(made, payload);
  dx::HitObject::Invoke(dx::HitObject::MakeNop(), payload);
  BuiltInTriangleIntersectionAttributes attributes;
  hit.GetAttributes(attributes);
  words.Store(32 * i, payload.hits);
  words.Store(32 * i + 4, payload.misses);
  words.Store(32 * i + 8, asuint(hit.GetRayTCurrent()));
  words.Store(32 * i + 12, hit.LoadLocalRootTableConstant(0));
  words.Store(32 * i + 16, asuint(hit.GetObjectRayOrigin().x));
  words.Store(32 * i + 20, asuint(attributes.barycentrics.x));
  words.Store(32 * i + 24, hit.GetInstanceID());
  words.Store(32 * i + 28, hit.GetHitKind());
}

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.hits += number + InstanceID();
}

[shader("miss")]
void Miss(inout Payload payload) {
  payload.misses += number;
}
