// SPDX-License-Identifier: MIT
// Four frames of villages in a partitioned top level, which shaders trace like any other.

RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<float4> image : register(u0);
cbuffer Frame : register(b0) {
  uint frame;  // its quarter of the picture, row by row
};

struct Payload {
  float3 color;
};
struct ShadowPayload {
  float visibility;
};

static const uint kPrimaryRay = 0;
static const uint kShadowRay = 1;

[shader("raygeneration")]
void RayGen() {
  uint2 size;
  image.GetDimensions(size.x, size.y);
  const float2 quarter = float2(DispatchRaysDimensions().xy);
  const uint2 pixel =
      DispatchRaysIndex().xy + uint2(frame % 2, frame / 2) * DispatchRaysDimensions().xy;
  if (any(pixel >= size)) return;
  const float2 uv = (float2(DispatchRaysIndex().xy) + 0.5) / quarter * 2.0 - 1.0;
  RayDesc ray;
  ray.Origin = float3(0, 9, -15);
  ray.Direction = normalize(float3(uv.x * quarter.x / quarter.y, -uv.y - 1.25, 2.4));
  ray.TMin = 0.0;
  ray.TMax = 1000.0;
  Payload payload = { float3(0, 0, 0) };
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 0, kPrimaryRay, ray, payload);
  // A border between the quarters.
  const bool border = any(DispatchRaysIndex().xy == 0);
  image[pixel] = float4(border ? float3(0, 0, 0) : sqrt(payload.color), 1.0);
}

[shader("miss")]
void PrimaryMiss(inout Payload payload) {
  payload.color = float3(0.75, 0.8, 0.88);
}

[shader("miss")]
void ShadowMiss(inout ShadowPayload payload) {
  payload.visibility = 1.0;
}

// InstanceID is the village, 4 for the ground or 5 for the tower.
float3 color_of(uint id) {
  static const float3 kColors[6] = {
    float3(0.75, 0.25, 0.15), float3(0.2, 0.5, 0.2), float3(0.2, 0.35, 0.7),
    float3(0.75, 0.6, 0.15), float3(0.6, 0.6, 0.6), float3(0.45, 0.15, 0.5)
  };
  return kColors[min(id, 5u)];
}

[shader("closesthit")]
void ClosestHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  RayDesc ray;
  ray.Origin = WorldRayOrigin() + RayTCurrent() * WorldRayDirection();
  ray.Direction = normalize(float3(-0.5, 1.0, -0.6));
  ray.TMin = 1e-3;
  ray.TMax = 1000.0;
  ShadowPayload shadow = { 0.0 };
  TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER, 0xFF,
           0, 0, kShadowRay, ray, shadow);
  // Each side of a house has a light of its own; the ground has that of its first one.
  const float side = 1.0 - 0.2 * float(PrimitiveIndex() / 2 % 4);
  payload.color = color_of(InstanceID()) * side * (0.35 + 0.65 * shadow.visibility);
}
