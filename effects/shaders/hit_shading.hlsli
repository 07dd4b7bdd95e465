// SPDX-License-Identifier: MIT
// Shades the hits of every effect, either with the full material or as a matte surface: emission,
// local lights with shadow maps, and the sun by a shadow ray, because maps for what the camera sees
// do not cover what it cannot see, or by the map of the whole scene. Indirect light is added
// elsewhere. [Northlight deck: Reflections, unified shading model]
#ifndef KAAMOS_HIT_SHADING_HLSLI
#define KAAMOS_HIT_SHADING_HLSLI

#include "hit_lighting.hlsli"
#include "matte_surface.hlsli"
#include "surface_brdf.hlsli"
#include "visibility.hlsli"

// These say whether hits are lit by the sun, and how its shadows are found.
static const uint kNoSunAtHits = 0;
static const uint kSunAtHitsByRay = 1;  // to the sun's centre
static const uint kSunAtHitsByMap = 2;  // and by a ray where the frame has no map, or beside it

// Tells whether the sun's centre is visible from a point of a surface; `origin` is where rays
// start.
float SunVisibility(uint sun, float3 position, float3 normal, float3 origin) {
  if (sun == kSunAtHitsByMap && IsInSunMap(position)) return SunMapVisibility(position, normal);
  return TraceVisibility(origin, frame.direction_to_sun, kSunDistance);
}

// Sunlight reflected by a surface.
float3 SunAtHit(uint sun, Surface surface, Brdf brdf, BrdfView view) {
  if (!(dot(surface.normal, frame.direction_to_sun) > 0.0)) return float3(0, 0, 0);
  const float3 unshadowed =
      frame.sun_irradiance * EvaluateBrdf(brdf, view, frame.direction_to_sun);
  if (!(RadianceLuminance(unshadowed) > 0.0)) return float3(0, 0, 0);
  return unshadowed * SunVisibility(sun, surface.position, surface.normal,
                                    SurfaceOrigin(surface, frame.direction_to_sun));
}

// Direct light reflected as if the surface were matte: one bounce of diffuse light. [Northlight
// deck: Diffuse Lighting on Hit Shader]
float3 ShadeMatteHit(MatteSurface surface, uint sun_at_hits) {
  float3 reflected = LocalMatteLights(surface.brdf, surface.position, surface.normal);
  const float facing = dot(surface.normal, frame.direction_to_sun);
  const float3 sun = frame.sun_irradiance * facing;
  if (sun_at_hits != kNoSunAtHits && RadianceLuminance(sun) > 0.0) {
    reflected += sun * SpreadAlbedo(surface.brdf, facing) *
                 SunVisibility(sun_at_hits, surface.position, surface.normal,
                               surface.position + surface.normal * surface.offset);
  }
  return surface.emissive + reflected * (1.0 / kBrdfPi);
}

// Radiance towards `direction`, where the ray came from, without indirect light.
float3 ShadeHit(Surface surface, float3 direction, uint sun_at_hits) {
  if (surface.is_unlit) return surface.emissive;
  const Brdf brdf = SurfaceBrdf(surface);
  const BrdfView view = MakeBrdfView(brdf, surface.shading_normal, direction);
  float3 radiance = surface.emissive;
  radiance += LocalLights(brdf, view, surface.position, surface.normal);
  if (sun_at_hits != kNoSunAtHits) radiance += SunAtHit(sun_at_hits, surface, brdf, view);
  return radiance;
}

#endif
