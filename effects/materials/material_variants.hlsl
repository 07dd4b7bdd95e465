// SPDX-License-Identifier: MIT
// What skin, eyes and hair look like by models of their own, in the light of the sun: the difference
// to the unified model, which is what that costs. [Control: material variants behind one model]
#include "surface_brdf.hlsli"
#include "variants.hlsli"
#include "visibility.hlsli"

// Radiance by the models of their own, less that by the unified one.
RWTexture2D<float4> variant_difference : register(u0, space3);

struct VariantConstants {
  uint at_hits;  // 1: what mirrors show has models of its own, too; 0: what the camera sees alone
};
ConstantBuffer<VariantConstants> constants : register(b0, space3);

struct VariantPayload {
  float3 difference;
  uint is_mirror;
  float3 origin;  // of the mirrored ray
  float3 direction;
  float3 mirrored;  // part of the light that the mirror sends on
};

[shader("miss")]
void VariantMiss(inout VariantPayload payload) {}

[shader("anyhit")]
void VariantAnyHit(inout VariantPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) IgnoreHit();
}

// The part of the sun that lights a point beyond the horizon, through the thing itself: the ray
// starts inside of it and leaves it by the backs of its triangles.
float VisibilityThrough(Surface surface, float3 light) {
  RayDesc ray;
  ray.Origin = SurfaceOrigin(surface, light);
  ray.TMin = 0.0;
  ray.Direction = light;
  ray.TMax = kSunDistance;
  VisibilityPayload payload;
  payload.visibility = 0.0;
  TraceRay(scene,
           RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER |
               RAY_FLAG_CULL_BACK_FACING_TRIANGLES,
           kMaskWithoutLamps, kRayTypeVisibility, kRayTypeCount, kRayTypeVisibility, ray, payload);
  return payload.visibility;
}

float3 Difference(Surface surface, uint flags) {
  const float3 light = frame.direction_to_sun, view_direction = -normalize(WorldRayDirection());
  const bool is_facing = dot(surface.normal, light) > 0.0;
  if ((flags & kMaterialEye) != 0 && !is_facing) return float3(0, 0, 0);
  const float sun = is_facing
                        ? TraceVisibility(SurfaceOrigin(surface, light), light, kSunDistance)
                        : VisibilityThrough(surface, light);
  Surface own = surface;
  if ((flags & kMaterialEye) != 0) {
    const float3 at = normalize(mul(WorldToObject3x4(), float4(surface.position, 1.0)));
    const float3 direction = normalize(ObjectRayDirection());
    own.base_color = EyeColor(IrisPlace(at, direction));
  }
  const Brdf own_brdf = SurfaceBrdf(own), unified_brdf = SurfaceBrdf(surface);
  const BrdfView own_view = MakeBrdfView(own_brdf, surface.shading_normal, view_direction);
  const BrdfView unified_view = MakeBrdfView(unified_brdf, surface.shading_normal, view_direction);
  float3 shown;
  if ((flags & kMaterialSkin) != 0) {
    shown = EvaluateSkin(own_brdf, own_view, light);
  } else if ((flags & kMaterialEye) != 0) {
    shown = EvaluateEye(own_brdf, own_view, light);
  } else {
    // Fibres run along the object's y axis.
    const float3 fibre = normalize(mul((float3x3)ObjectToWorld3x4(), float3(0, 1, 0)));
    shown = EvaluateHair(own_brdf, fibre, view_direction, light);
  }
  if (is_facing) shown -= EvaluateBrdf(unified_brdf, unified_view, light);
  return frame.sun_irradiance * sun * shown;
}

[shader("closesthit")]
void VariantClosestHit(inout VariantPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const Surface surface = LoadSurface(hit.barycentrics, ConeWidth());
  const uint flags = materials[hit_constants.material_id].flags;
  if ((flags & kMaterialVariants) != 0) {
    payload.difference = Difference(surface, flags);
    return;
  }
  if (!IsMirror(surface.roughness)) return;
  const float3 towards = normalize(WorldRayDirection());
  const Brdf brdf = SurfaceBrdf(surface);
  payload.is_mirror = 1;
  payload.direction = reflect(towards, surface.shading_normal);
  payload.origin = SurfaceOrigin(surface, payload.direction);
  payload.mirrored = MakeBrdfView(brdf, surface.shading_normal, -towards).specular;
}

VariantPayload Trace(float3 origin, float3 direction) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0.0;
  ray.Direction = direction;
  ray.TMax = kLongestRay;
  VariantPayload payload;
  payload.difference = float3(0, 0, 0);
  payload.is_mirror = 0;
  payload.origin = payload.direction = payload.mirrored = float3(0, 0, 0);
  TraceRay(scene, RAY_FLAG_NONE, kMaskSolid, kRayTypeSurface, kRayTypeCount, kRayTypeSurface, ray,
           payload);
  return payload;
}

[shader("raygeneration")]
void VariantRayGen() {
  const uint2 pixel = FramePixel();
  uint2 size;
  variant_difference.GetDimensions(size.x, size.y);
  const CameraRay through =
      RayThrough((float2(pixel) + 0.5 + frame.jitter) / float2(size) * 2.0 - 1.0);
  VariantPayload seen = Trace(through.origin, through.direction);
  float3 difference = seen.difference;
  if (seen.is_mirror != 0 && constants.at_hits != 0) {
    difference = seen.mirrored * Trace(seen.origin, seen.direction).difference;
  }
  variant_difference[pixel] = float4(difference, 1.0);
}

// The frame has the unified model.
[shader("compute")]
[numthreads(8, 8, 1)]
void VariantCompose(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  radiance.GetDimensions(width, height);
  if (id.x >= width || id.y >= height) return;
  radiance[id.xy] = max(radiance[id.xy] + float4(variant_difference[id.xy].rgb, 0.0), 0.0);
}
