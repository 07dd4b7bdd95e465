// SPDX-License-Identifier: MIT
// A landscape of clusters, each in a colour of its own. Rays meet clusters like other triangles;
// ClusterID() says of which one the triangle is.

RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<float4> image : register(u0);

struct [raypayload] Payload {
  float3 color : write(caller, closesthit, miss) : read(caller);
};
struct [raypayload] ShadowPayload {
  float visibility : write(caller, miss) : read(caller);
};

static const uint kPrimaryRay = 0;
static const uint kShadowRay = 1;

[shader("raygeneration")]
void RayGen() {
  const uint2 pixel = DispatchRaysIndex().xy;
  const float2 size = float2(DispatchRaysDimensions().xy);
  const float2 uv = (float2(pixel) + 0.5) / size * 2.0 - 1.0;
  RayDesc ray;
  ray.Origin = float3(0, 7, -11);
  ray.Direction = normalize(float3(uv.x * size.x / size.y, -uv.y - 1.2, 2.0));
  ray.TMin = 0.0;
  ray.TMax = 1000.0;
  Payload payload = { float3(0, 0, 0) };
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 0, kPrimaryRay, ray, payload);
  image[pixel] = float4(sqrt(payload.color), 1.0);
}

[shader("miss")]
void PrimaryMiss(inout Payload payload) {
  payload.color = float3(0.75, 0.8, 0.88);
}

[shader("miss")]
void ShadowMiss(inout ShadowPayload payload) {
  payload.visibility = 1.0;
}

// main.cpp computes the same heights: 0.6 sin(1.1 x) cos(0.9 z + 0.5 x).
float3 normal_at(float2 at) {
  const float a = 1.1 * at.x;
  const float b = 0.9 * at.y + 0.5 * at.x;
  const float slope_x = 0.6 * (1.1 * cos(a) * cos(b) - 0.5 * sin(a) * sin(b));
  const float slope_z = -0.54 * sin(a) * sin(b);
  return normalize(float3(-slope_x, 1.0, -slope_z));
}

// Hues that differ between neighbours.
float3 color_of(uint cluster) {
  const float hue = frac(float(cluster) * 0.618034);
  return saturate(abs(frac(hue + float3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0) * 0.6 + 0.2;
}

[shader("closesthit")]
void ClosestHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  RayDesc ray;
  ray.Origin = WorldRayOrigin() + RayTCurrent() * WorldRayDirection();
  ray.Direction = normalize(float3(-0.8, 0.6, 0.3));
  ray.TMin = 1e-2;
  ray.TMax = 1000.0;
  ShadowPayload shadow = { 0.0 };
  TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER, 0xFF,
           0, 0, kShadowRay, ray, shadow);
  const float facing = saturate(dot(normal_at(ray.Origin.xz), ray.Direction));
  payload.color = color_of(ClusterID()) * (0.25 + 0.9 * facing * shadow.visibility);
}
