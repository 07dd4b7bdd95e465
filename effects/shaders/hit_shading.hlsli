// SPDX-License-Identifier: MIT
// How every effect shades its hits, either with the full material or as a matte surface: emission,
// local lights with shadow maps, and the sun by a shadow ray, because shadow maps do not cover what
// the camera cannot see. Indirect light is added elsewhere. [Northlight deck: unified material;
// effects-spec B4.10]
#ifndef KAAMOS_HIT_SHADING_HLSLI
#define KAAMOS_HIT_SHADING_HLSLI

#include "hit_lighting.hlsli"
#include "surface.hlsli"
#include "visibility.hlsli"

// Sunlight reflected by a surface, shadowed by one ray to the centre of the sun.
float3 SunAtHit(Surface surface, Brdf brdf, BrdfView view) {
  if (!(dot(surface.normal, frame.direction_to_sun) > 0.0)) return float3(0, 0, 0);
  const float3 unshadowed =
      frame.sun_irradiance * EvaluateBrdf(brdf, view, frame.direction_to_sun);
  if (!(RadianceLuminance(unshadowed) > 0.0)) return float3(0, 0, 0);
  return unshadowed * TraceVisibility(SurfaceOrigin(surface, frame.direction_to_sun),
                                      frame.direction_to_sun, kSunDistance);
}

// Direct light reflected as if the surface were matte: one bounce of diffuse light. [effects-spec
// B5.4]
float3 ShadeMatteHit(MatteSurface surface, bool with_sun) {
  float3 irradiance = LocalIrradiance(surface.position, surface.normal);
  const float3 sun = frame.sun_irradiance * dot(surface.normal, frame.direction_to_sun);
  if (with_sun && RadianceLuminance(sun) > 0.0) {
    irradiance += sun * TraceVisibility(surface.position + surface.normal * surface.offset,
                                        frame.direction_to_sun, kSunDistance);
  }
  return surface.emissive + surface.base_color * (irradiance * (1.0 / kBrdfPi));
}

// Radiance towards `direction`, where the ray came from, without indirect light.
float3 ShadeHit(Surface surface, float3 direction, bool with_sun) {
  const Brdf brdf = MakeBrdf(surface.base_color, surface.metallic, surface.roughness);
  const BrdfView view = MakeBrdfView(brdf, surface.shading_normal, direction);
  float3 radiance = surface.emissive;
  radiance += LocalLights(brdf, view, surface.position, surface.normal);
  if (with_sun) radiance += SunAtHit(surface, brdf, view);
  return radiance;
}

#endif
