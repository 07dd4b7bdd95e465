// SPDX-License-Identifier: MIT
// The two kinds of rays of a path: one that wants to know what it hits, and one that wants to know
// whether a light is free.
#ifndef KAAMOS_PATH_HIT_HLSLI
#define KAAMOS_PATH_HIT_HLSLI

#include "alpha_test.hlsli"
#include "pane_tint.hlsli"
#include "path_lights.hlsli"

static const uint kGlassOnly = 0x02;  // [effects/assets/scene/scene.h: InstanceMask]

struct PathHit {
  float3 position;
  float offset;
  float3 normal;
  float distance;  // negative: a miss
  float3 shading_normal;
  float roughness;
  float3 base_color;
  float metallic;
  float3 emissive;
  float emitter_density;  // of SampleEmitter at this point, 1/m^2
  float opacity;
  uint is_glass_ray;
  uint is_camera_ray;     // textures are filtered over the pixel
  uint is_unlit;          // the surface emits, and reflects nothing
  float3 dielectric_f0;   // as in Surface
  float dielectric_f90;
};

PathHit NoHit() {
  PathHit hit;
  hit.position = hit.normal = hit.shading_normal = hit.base_color = hit.emissive = float3(0, 0, 0);
  hit.offset = hit.roughness = hit.metallic = hit.emitter_density = hit.opacity = 0.0;
  hit.dielectric_f0 = float3(0, 0, 0);
  hit.dielectric_f90 = 0.0;
  hit.distance = -1.0;
  hit.is_glass_ray = hit.is_camera_ray = hit.is_unlit = 0;
  return hit;
}

[shader("miss")]
void PathTracerMiss(inout PathHit payload) {
  payload.distance = -1.0;
}

// Single-sided glass is seen from its front only.
bool IsSeenGlass(float2 barycentrics) {
  const MaterialConstants material = materials[hit_constants.material_id];
  const uint3 corners = LoadTriangle(indices, hit_constants.index_size_bytes, PrimitiveIndex());
  if ((material.flags & kMaterialDoubleSided) == 0) {
    const float3 p0 = LoadVertexFloat3(vertices, hit_constants.vertex_stride, 0, corners.x);
    const float3 p1 = LoadVertexFloat3(vertices, hit_constants.vertex_stride, 0, corners.y);
    const float3 p2 = LoadVertexFloat3(vertices, hit_constants.vertex_stride, 0, corners.z);
    if (dot(ObjectRayDirection(), cross(p1 - p0, p2 - p0)) > 0.0) return false;
  }
  const float2 uv = LoadUvOf(vertices, hit_constants, corners, barycentrics,
                             UsesSecondUv(material, kBaseColorTexture));
  float alpha =
      material.base_color.a * SampleMaterial(material, kBaseColorTexture, uv, kFinestLevel).a;
  if (hit_constants.color_offset != 0) {
    alpha *= LoadColor(vertices, hit_constants, corners, barycentrics).w;
  }
  return alpha > 0.0;
}

[shader("anyhit")]
void PathTracerAnyHit(inout PathHit payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (payload.is_glass_ray != 0) {
    if (!IsSeenGlass(hit.barycentrics)) {
      IgnoreHit();
    }
  } else if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

[shader("closesthit")]
void PathTracerClosestHit(inout PathHit payload, in BuiltInTriangleIntersectionAttributes hit) {
  const Surface surface =
      LoadSurface(hit.barycentrics, payload.is_camera_ray != 0 ? ConeWidth() : 0.0);
  payload.position = surface.position;
  payload.offset = surface.offset;
  payload.normal = surface.normal;
  payload.distance = RayTCurrent();
  payload.shading_normal = surface.shading_normal;
  payload.base_color = surface.base_color;
  payload.roughness = surface.roughness;
  payload.metallic = surface.metallic;
  payload.dielectric_f0 = surface.dielectric_f0;
  payload.dielectric_f90 = surface.dielectric_f90;
  payload.emissive = surface.emissive;
  payload.opacity = surface.opacity;
  payload.is_unlit = surface.is_unlit ? 1 : 0;
  payload.emitter_density = emitting_instances[InstanceIndex()] != 0
                                ? emitter_densities[hit_constants.material_id] : 0.0;
}

struct ShadowPayload {
  uint is_free;
  float tint;      // of PaneTransmittance; negative: of a ray that asks for solid things
  float3 through;  // what panes let through
};

[shader("miss")]
void PathShadowMiss(inout ShadowPayload payload) {
  payload.is_free = 1;
}

[shader("anyhit")]
void PathShadowAnyHit(inout ShadowPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (payload.tint >= 0.0) {
    payload.through *= PaneTransmittance(PaneColorAt(hit.barycentrics), payload.tint);
    IgnoreHit();
  }
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

bool IsFree(float3 origin, float3 direction, float reach) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0.0;
  ray.Direction = direction;
  ray.TMax = reach;
  ShadowPayload payload;
  payload.is_free = 0;
  payload.tint = -1.0;
  payload.through = float3(1, 1, 1);
  TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER,
           kMaskWithoutLamps, kRayTypeVisibility, kRayTypeCount, kRayTypeVisibility, ray, payload);
  return payload.is_free != 0;
}

// What the panes on a way let through, straight on and by colour.
float3 ThroughPanes(float3 origin, float3 direction, float reach, float tint) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0.0;
  ray.Direction = direction;
  ray.TMax = reach;
  ShadowPayload payload;
  payload.is_free = 0;
  payload.tint = tint;
  payload.through = float3(1, 1, 1);
  TraceRay(scene, RAY_FLAG_SKIP_CLOSEST_HIT_SHADER, kGlassOnly, kRayTypeVisibility, kRayTypeCount,
           kRayTypeVisibility, ray, payload);
  return payload.through;
}

PathHit Follow(float3 origin, float3 direction, float t_min, uint mask, bool is_camera_ray) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = t_min;
  ray.Direction = direction;
  ray.TMax = kLongestRay;
  PathHit hit = NoHit();
  hit.is_glass_ray = mask == kGlassOnly ? 1 : 0;
  hit.is_camera_ray = is_camera_ray ? 1 : 0;
  TraceRay(scene, RAY_FLAG_NONE, mask, kRayTypeSurface, kRayTypeCount, kRayTypeSurface, ray, hit);
  return hit;
}

#endif
