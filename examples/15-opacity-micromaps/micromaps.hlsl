// SPDX-License-Identifier: MIT
// The screen of 03-any-hit-alpha, with opacity micromaps: the any-hit shader counts how often it
// had to be asked, and the picture shows it.

RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<float4> image : register(u0);

struct Payload {
  float3 color;
  uint asked;  // any-hit shaders that ran
};
struct ShadowPayload {
  float visibility;
};

static const uint kPrimaryRay = 0;
static const uint kShadowRay = 1;
static const uint kRayTypes = 2;

// As in 03-any-hit-alpha. main.cpp bakes the micromaps from the same two functions.
float2 quad_uv(float2 barycentrics, uint primitive) {
  const float b1 = barycentrics.x;
  const float b2 = barycentrics.y;
  return primitive % 2 == 0 ? float2(b1 + b2, b2) : float2(b1, b1 + b2);
}

bool is_hole(float2 uv) {
  const float2 cell = frac(uv * 5.0) - 0.5;
  return abs(cell.x) + cell.y * cell.y * 2.0 > 0.36;
}

[shader("raygeneration")]
void RayGen() {
  const uint2 pixel = DispatchRaysIndex().xy;
  const float2 size = float2(DispatchRaysDimensions().xy);
  const float2 uv = (float2(pixel) + 0.5) / size * 2.0 - 1.0;
  RayDesc ray;
  ray.Origin = float3(0, 2.2, -6);
  ray.Direction = normalize(float3(uv.x * size.x / size.y, -uv.y - 0.45, 2.2));
  ray.TMin = 0.0;
  ray.TMax = 1000.0;
  Payload payload = { float3(0, 0, 0), 0 };
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, kPrimaryRay, kRayTypes, kPrimaryRay, ray, payload);
  const float3 orange = float3(0.9, 0.35, 0.02);
  image[pixel] = float4(sqrt(payload.asked != 0 ? orange : payload.color), 1.0);
}

[shader("miss")]
void PrimaryMiss(inout Payload payload) {
  const float height = saturate(WorldRayDirection().y * 1.5);
  const float3 color = lerp(float3(0.92, 0.9, 0.86), float3(0.4, 0.6, 0.85), height);
  payload.color = color * color;
}

[shader("miss")]
void ShadowMiss(inout ShadowPayload payload) {
  payload.visibility = 1.0;
}

// Runs only where a micro-triangle is unknown.
[shader("anyhit")]
void LeafAnyHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  ++payload.asked;
  if (is_hole(quad_uv(hit.barycentrics, PrimitiveIndex()))) {
    IgnoreHit();
  }
}

[shader("anyhit")]
void LeafAnyHitShadow(inout ShadowPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (is_hole(quad_uv(hit.barycentrics, PrimitiveIndex()))) {
    IgnoreHit();
  }
}

float sun_visibility() {
  RayDesc ray;
  ray.Origin = WorldRayOrigin() + RayTCurrent() * WorldRayDirection();
  ray.Direction = normalize(float3(-0.4, 1.0, -0.35));
  ray.TMin = 1e-3;
  ray.TMax = 1000.0;
  ShadowPayload payload = { 0.0 };
  TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER, 0xFF,
           kShadowRay, kRayTypes, kShadowRay, ray, payload);
  return payload.visibility;
}

[shader("closesthit")]
void FloorClosestHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  payload.color = 0.5 * (0.25 + 0.75 * sun_visibility());
}

[shader("closesthit")]
void LeafClosestHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  payload.color = float3(0.2, 0.5, 0.12) * (0.4 + 0.6 * sun_visibility());
}
