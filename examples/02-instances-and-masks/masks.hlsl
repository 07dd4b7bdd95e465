// SPDX-License-Identifier: MIT
// One pyramid, placed many times. The picture has three parts: rays on the left see only instances
// with mask 1, in the middle only those with mask 2, on the right both.

RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<float4> image : register(u0);

struct Payload {
  float3 color;
};

float3 color_of(uint id) {
  // A different hue for each instance.
  const float hue = frac(float(id) * 0.618034);
  return saturate(abs(frac(hue + float3(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0);
}

[shader("raygeneration")]
void RayGen() {
  const uint2 pixel = DispatchRaysIndex().xy;
  const float2 size = float2(DispatchRaysDimensions().xy);
  const float2 uv = (float2(pixel) + 0.5) / size;
  const uint part = min(uint(uv.x * 3.0), 2u);
  const uint mask = part == 0 ? 1 : part == 1 ? 2 : 3;

  // Each part shows the same view.
  const float2 local = float2(frac(uv.x * 3.0), uv.y) * 2.0 - 1.0;
  RayDesc ray;
  ray.Origin = float3(0, 4, -9);
  ray.Direction = normalize(float3(local.x * size.x / 3.0 / size.y, -local.y - 0.75, 2.0));
  ray.TMin = 0.0;
  ray.TMax = 100.0;
  Payload payload = { float3(0, 0, 0) };
  TraceRay(scene, RAY_FLAG_NONE, mask, 0, 1, 0, ray, payload);

  const bool separator = abs(frac(uv.x * 3.0) - 0.5) > 0.5 - 3.0 / size.x && uv.x > 0.1 && uv.x < 0.9;
  image[pixel] = float4(separator ? float3(0, 0, 0) : payload.color, 1.0);
}

[shader("miss")]
void Miss(inout Payload payload) {
  payload.color = float3(0.85, 0.87, 0.9);
}

[shader("closesthit")]
void ClosestHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes attributes) {
  // Each face of the pyramid is lit by its number; the colour is the instance's.
  const float light = 0.45 + 0.55 * frac(float(PrimitiveIndex()) * 0.37 + 0.2);
  payload.color = color_of(InstanceID()) * light;
}
