// SPDX-License-Identifier: MIT
// Ray i starts at (1 + 3 i, 0, 0) and goes along +z up to TMax = g_constants.x / 2.

RWByteAddressBuffer g_out : register(u0);
RaytracingAccelerationStructure g_scene : register(t0);
cbuffer Constants : register(b0) { uint4 g_constants; }

struct Payload {
  uint value;
};
struct Mine {
  float3 normal;
};

RayDesc ray_of(uint index) {
  RayDesc ray;
  ray.Origin = float3(1 + 3 * float(index), 0, 0);
  ray.TMin = 0;
  ray.Direction = float3(0, 0, 1);
  ray.TMax = 0.5f * float(g_constants.x);
  return ray;
}

// Word i: a bit for each box whose intersection shader ran, or that a RayQuery offered; word 16 + i:
// what the ray brought back.
[shader("raygeneration")]
void Trace() {
  const uint index = DispatchRaysIndex().x;
  Payload payload = {0};
  TraceRay(g_scene, RAY_FLAG_NONE, 0xFF, 0, 0, 0, ray_of(index), payload);
  g_out.Store(4 * (16 + index), payload.value);
}

[shader("raygeneration")]
void Query() {
  const uint index = DispatchRaysIndex().x;
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(g_scene, RAY_FLAG_NONE, 0xFF, ray_of(index));
  uint met = 0;
  while (query.Proceed()) met |= 1u << query.CandidatePrimitiveIndex();
  g_out.Store(4 * index, met);
}

[shader("miss")]
void Miss(inout Payload payload) { payload.value = 7; }

void note() {
  uint before;
  g_out.InterlockedOr(4 * DispatchRaysIndex().x, 1u << PrimitiveIndex(), before);
}

[shader("intersection")]
void Note() { note(); }

[shader("intersection")]
void Report() {
  note();
  Mine attributes = {float3(0, 0, 20 + float(PrimitiveIndex()))};
  ReportHit(RayTCurrent() * 0.5f, 3, attributes);
}

[shader("closesthit")]
void OfTriangles(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.value = 100 + HitKind();
}

[shader("closesthit")]
void ReadingTriangles(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.value = uint(attributes.barycentrics.x);
}

[shader("closesthit")]
void OfMine(inout Payload payload, Mine attributes) {
  payload.value = 200 + uint(attributes.normal.z);
}

[shader("anyhit")]
void AnyOfTriangles(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.value = 1;
  AcceptHitAndEndSearch();
}
