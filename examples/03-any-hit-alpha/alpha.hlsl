// SPDX-License-Identifier: MIT
// An any-hit shader cuts holes, for camera rays and for shadow rays: two ray types, so two records
// for each geometry.

RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<float4> image : register(u0);

static const uint kPrimaryRay = 0;
static const uint kShadowRay = 1;
static const uint kRayTypes = 2;

struct PrimaryPayload {
  float3 color;
};
struct ShadowPayload {
  float visibility;
};

// The texture coordinates of a hit on a quad, whose two triangles share corners 0 and 2; is_hole()
// leaves a leaf standing in each square.
float2 quad_uv(float2 barycentrics, uint primitive) {
  const float b1 = barycentrics.x;
  const float b2 = barycentrics.y;
  return primitive % 2 == 0 ? float2(b1 + b2, b2) : float2(b1, b1 + b2);
}

bool is_hole(float2 uv) {
  const float2 cell = frac(uv * 5.0) - 0.5;
  return abs(cell.x) + cell.y * cell.y * 2.0 > 0.36;
}

float3 sky(float3 direction) {
  return lerp(float3(0.92, 0.9, 0.86), float3(0.4, 0.6, 0.85), saturate(direction.y * 1.5));
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
  PrimaryPayload payload = { float3(0, 0, 0) };
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, kPrimaryRay, kRayTypes, kPrimaryRay, ray, payload);
  image[pixel] = float4(sqrt(payload.color), 1.0);
}

[shader("miss")]
void PrimaryMiss(inout PrimaryPayload payload) {
  const float3 color = sky(WorldRayDirection());
  payload.color = color * color;
}

// A shadow ray that hits nothing sees the sun.
[shader("miss")]
void ShadowMiss(inout ShadowPayload payload) {
  payload.visibility = 1.0;
}

[shader("anyhit")]
void LeafAnyHitPrimary(inout PrimaryPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
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

float sun_visibility(float3 position) {
  RayDesc ray;
  ray.Origin = position;
  ray.Direction = normalize(float3(-0.4, 1.0, -0.35));
  ray.TMin = 1e-3;
  ray.TMax = 1000.0;
  ShadowPayload payload = { 0.0 };
  TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER, 0xFF,
           kShadowRay, kRayTypes, kShadowRay, ray, payload);
  return payload.visibility;
}

[shader("closesthit")]
void FloorClosestHit(inout PrimaryPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const float3 position = WorldRayOrigin() + RayTCurrent() * WorldRayDirection();
  const float2 tile = floor(position.xz);
  const float shade = abs(tile.x + tile.y) % 2.0 == 0.0 ? 0.55 : 0.42;
  payload.color = shade * (0.25 + 0.75 * sun_visibility(position));
}

[shader("closesthit")]
void LeafClosestHit(inout PrimaryPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const float3 position = WorldRayOrigin() + RayTCurrent() * WorldRayDirection();
  payload.color = float3(0.2, 0.5, 0.12) * (0.4 + 0.6 * sun_visibility(position));
}
