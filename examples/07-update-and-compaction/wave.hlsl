// SPDX-License-Identifier: MIT
// The same view of two top levels: before and after a mesh has moved.

RaytracingAccelerationStructure before : register(t0);
RaytracingAccelerationStructure after : register(t1);
RWTexture2D<float4> image : register(u0);

struct Payload {
  float3 color;
};

[shader("raygeneration")]
void RayGen() {
  const uint2 pixel = DispatchRaysIndex().xy;
  const float2 size = float2(DispatchRaysDimensions().xy);
  const float2 uv = (float2(pixel) + 0.5) / size;
  const bool left = uv.x < 0.5;
  const float2 local = float2(frac(uv.x * 2.0), uv.y) * 2.0 - 1.0;
  RayDesc ray;
  ray.Origin = float3(0, 1.6, -2.6);
  ray.Direction = normalize(float3(local.x * size.x * 0.5 / size.y, -local.y - 1.15, 2.0));
  ray.TMin = 0.0;
  ray.TMax = 100.0;
  Payload payload = { float3(0, 0, 0) };
  if (left) {
    TraceRay(before, RAY_FLAG_NONE, 0xFF, 0, 1, 0, ray, payload);
  } else {
    TraceRay(after, RAY_FLAG_NONE, 0xFF, 0, 1, 0, ray, payload);
  }
  image[pixel] = float4(payload.color, 1.0);
}

[shader("miss")]
void Miss(inout Payload payload) {
  payload.color = float3(0.9, 0.9, 0.92);
}

// Lines of equal height; the two triangles of each square have different shades.
[shader("closesthit")]
void ClosestHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const float height = WorldRayOrigin().y + RayTCurrent() * WorldRayDirection().y;
  const float band = frac(height * 16.0) < 0.15 ? 0.4 : 1.0;
  const float shade = PrimitiveIndex() % 2 == 0 ? 1.0 : 0.88;
  payload.color = lerp(float3(0.1, 0.3, 0.55), float3(0.85, 0.9, 0.75), saturate(height + 0.5)) * band * shade;
}
