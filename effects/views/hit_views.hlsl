// SPDX-License-Identifier: MIT
// Shows what the first reflection ray of each pixel hits: one closest-hit shader per view.
#include "../reflections/traced/reflection_ray.hlsli"
#include "hit_indirect.hlsli"

// Three numbers of the hit, and its distance in metres; -1: the ray hits nothing, 0: there is no
// ray.
RWTexture2D<float4> numbers : register(u0, space3);
ConstantBuffer<ReflectionLengths> lengths : register(b0, space3);

struct ViewPayload {
  float3 value;
  float distance;
};

[shader("miss")]
void ViewMiss(inout ViewPayload payload) {
  payload.distance = -1.0;
}

[shader("anyhit")]
void ViewAnyHit(inout ViewPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

// Texture coordinates, as the vertices have them.
[shader("closesthit")]
void HitUv(inout ViewPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const TriangleHit triangle_hit = RayHit(hit.barycentrics);
  const HitPoint found = LoadHitPoint(vertices, indices, triangle_hit);
  payload.value = float3(LoadHitTexel(vertices, triangle_hit, found,
                                      materials[triangle_hit.layout.material_id], 0.0).uv, 0.0);
  payload.distance = RayTCurrent();
}

[shader("closesthit")]
void HitAlbedo(inout ViewPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  payload.value = LoadSurface(hit.barycentrics, ConeWidth()).base_color;
  payload.distance = RayTCurrent();
}

// Computes what a white matte surface would reflect there: local lights, the sun by a shadow ray,
// and the volume of indirect light.
[shader("closesthit")]
void HitLighting(inout ViewPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  MatteSurface surface = LoadMatteSurface(hit.barycentrics, ConeWidth());
  surface.brdf = MakeSpreadBrdf(1.0);
  surface.emissive = float3(0, 0, 0);
  payload.value = ShadeMatteHit(surface, true) + IndirectAtMatteHit(surface, kEveryCell, -WorldRayDirection());
  payload.distance = RayTCurrent();
}

[shader("raygeneration")]
void HitViewRayGen() {
  const uint2 pixel = FramePixel();
  numbers[pixel] = float4(0, 0, 0, 0);
  if (g_ids[pixel].x == 0) return;
  const ReflectionPoint surface = LoadReflectionPoint(pixel);
  const ReflectionRay sample = SampleReflectionRay(pixel, surface, lengths, 0, frame.seed);
  if (!sample.exists) return;
  RayDesc ray;
  ray.Origin = surface.origin;
  ray.TMin = 0.0;
  ray.Direction = sample.direction;
  ray.TMax = sample.length;
  ViewPayload payload;
  payload.value = float3(0, 0, 0);
  payload.distance = -1.0;
  TraceRay(scene, RAY_FLAG_NONE, ReflectionMask(surface.roughness), kRayTypeSurface, kRayTypeCount,
           kRayTypeSurface, ray, payload);
  numbers[pixel] = float4(payload.value, payload.distance);
}
