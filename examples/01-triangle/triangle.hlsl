// SPDX-License-Identifier: MIT
// One ray for each pixel, one triangle: hits are coloured by barycentrics, misses by the sky.

RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<float4> image : register(u0);

struct Payload {
  float3 color;
};

[shader("raygeneration")]
void RayGen() {
  const uint2 pixel = DispatchRaysIndex().xy;
  const float2 size = float2(DispatchRaysDimensions().xy);
  const float2 uv = (float2(pixel) + 0.5) / size * 2.0 - 1.0;

  // A pinhole camera two units in front of the triangle.
  RayDesc ray;
  ray.Origin = float3(0, 0, -2);
  ray.Direction = normalize(float3(uv.x * size.x / size.y, -uv.y, 2.0));
  ray.TMin = 0.0;
  ray.TMax = 100.0;

  Payload payload;
  payload.color = float3(0, 0, 0);
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0, ray, payload);
  image[pixel] = float4(payload.color, 1.0);
}

[shader("miss")]
void Miss(inout Payload payload) {
  const float height = saturate(WorldRayDirection().y + 0.5);
  payload.color = lerp(float3(0.9, 0.9, 0.85), float3(0.25, 0.45, 0.8), height);
}

[shader("closesthit")]
void ClosestHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes attributes) {
  const float2 b = attributes.barycentrics;
  payload.color = float3(1.0 - b.x - b.y, b.x, b.y);
}
