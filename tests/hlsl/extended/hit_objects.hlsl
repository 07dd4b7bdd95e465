// SPDX-License-Identifier: MIT
// FEATURE: extended HitObject, MaybeReorderThread
// OPTIONS: -T lib_6_9 -disable-payload-qualifiers
// EXPECT f32 0 13 0.5 0.25
// EXPECT u32 12 2 0 1 7 254 0
// EXPECT f32 36 13 0 0 0
// EXPECT u32 52 2 110 99 0
// EXPECT f32 68 19.5 19.5 0 0 0
// EXPECT u32 88 33 5 4 38 5 0 0
// EXPECT u32 116 99 1 0 1
// EXPECT u32 132 4 1024
#include "scene.hlsli"

struct BoxAttributes {
  uint number;
  float distance;
};

// Hits before t = 6 are ignored, so that the second triangle is met.
[shader("anyhit")]
void Second(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.x += 1;
  if (RayTCurrent() < 6) IgnoreHit();
}

[shader("closesthit")]
void Further(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color.x = RayTCurrent();
  payload.numbers.y = 100 * GeometryIndex() + 10 * PrimitiveIndex() +
                      10 * (attributes.barycentrics.x == 0.5);
  // A trace by a shader that a hit object runs.
  RayDesc beside = {float3(1000, 0, 0), 0, float3(0, 0, 1), 10};
  payload.numbers.z = trace(RAY_FLAG_NONE, 0xFF, beside).numbers.w;
}

// The first report is nearer than the second, which is not accepted.
[shader("intersection")]
void BoxReports() {
  BoxAttributes attributes = {5, 19.5};
  const bool first = ReportHit(19.5, 33, attributes);
  attributes.number = 6;
  const bool second = ReportHit(20, 34, attributes);
  results.Store(132, first * 4 + second);
}

[shader("anyhit")]
void BoxSeen(inout Payload payload, BoxAttributes attributes) {
  payload.numbers.x += HitKind() + attributes.number;
}

[shader("closesthit")]
void BoxHit(inout Payload payload, BoxAttributes attributes) {
  payload.color.x = attributes.distance;
  payload.numbers.y = attributes.number;
}

[shader("raygeneration")]
void main() {
  const float z = results.Load(65532);  // 0, known at run time only
  Payload payload = (Payload)0;
  const dx::HitObject hit =
      dx::HitObject::TraceRay(scene, RAY_FLAG_NONE, 0x0F, 0, 0, 0, test_ray(z), payload);
  BuiltInTriangleIntersectionAttributes barycentrics;
  hit.GetAttributes(barycentrics);
  results.Store<float>(0, hit.GetRayTCurrent());
  results.Store<float2>(4, barycentrics.barycentrics);
  results.Store4(12, uint4(payload.numbers.x, hit.GetPrimitiveIndex(), hit.GetGeometryIndex(),
                           hit.GetInstanceID()));
  results.Store2(28, uint2(hit.GetHitKind(), hit.GetShaderTableIndex()));
  dx::MaybeReorderThread(hit, 1, 4);
  dx::HitObject::Invoke(hit, payload);
  store(36, payload);

  payload = (Payload)0;
  const dx::HitObject box =
      dx::HitObject::TraceRay(scene, RAY_FLAG_FORCE_OMM_2_STATE, 0xF0, 0, 0, 0, test_ray(z), payload);
  results.Store(136, box.GetRayFlags());
  dx::HitObject::Invoke(box, payload);
  const uint seen = payload.numbers.x;
  results.Store<float>(68, box.GetRayTCurrent());
  results.Store<float4>(72, payload.color);
  results.Store2(88, uint2(box.GetHitKind(), box.GetAttributes<BoxAttributes>().number));
  results.Store(96, box.GetShaderTableIndex());
  results.Store4(100, uint4(seen, payload.numbers.yzw));

  payload = (Payload)0;
  dx::HitObject miss = dx::HitObject::MakeMiss(RAY_FLAG_NONE, 0, test_ray(z));
  dx::HitObject::Invoke(miss, payload);
  results.Store4(116, uint4(payload.numbers.w, miss.IsMiss(), miss.IsHit(),
                            dx::HitObject::MakeNop().IsNop()));
}
