// SPDX-License-Identifier: MIT
// How every effect shades what its rays hit, by its material or as if it were matte: emitted light,
// local lights with their shadow maps, the sun by a ray of its own (no shadow map knows what the
// camera does not see), and indirect light. [Northlight deck: unified material; effects-spec B4.10]
#ifndef KAAMOS_HIT_SHADING_HLSLI
#define KAAMOS_HIT_SHADING_HLSLI

#include "hit_lighting.hlsli"
#include "surface.hlsli"
#include "visibility.hlsli"

// The sun's light by a surface, shadowed by one ray to its middle.
float3 SunAtHit(Surface surface, Brdf brdf, BrdfView view) {
  if (!(dot(surface.normal, frame.direction_to_sun) > 0.0)) return float3(0, 0, 0);
  const float3 unshadowed =
      frame.sun_irradiance * EvaluateBrdf(brdf, view, frame.direction_to_sun);
  if (!(RadianceLuminance(unshadowed) > 0.0)) return float3(0, 0, 0);
  return unshadowed * TraceVisibility(SurfaceOrigin(surface, frame.direction_to_sun),
                                      frame.direction_to_sun, kSunDistance);
}

// Direct light that a hit sends everywhere alike: one bounce of diffuse light. [effects-spec B5.4]
float3 ShadeMatteHit(MatteSurface surface, bool with_sun) {
  float3 irradiance = LocalIrradiance(surface.position, surface.normal);
  const float3 sun = frame.sun_irradiance * dot(surface.normal, frame.direction_to_sun);
  if (with_sun && RadianceLuminance(sun) > 0.0) {
    irradiance += sun * TraceVisibility(surface.position + surface.normal * surface.offset,
                                        frame.direction_to_sun, kSunDistance);
  }
  return surface.emissive + surface.base_color * (irradiance * (1.0 / kBrdfPi));
}

// Radiance from a hit in a direction, that where the ray came from, without indirect light.
float3 ShadeHit(Surface surface, float3 direction, bool with_sun) {
  const Brdf brdf = MakeBrdf(surface.base_color, surface.metallic, surface.roughness);
  const BrdfView view = MakeBrdfView(brdf, surface.shading_normal, direction);
  float3 radiance = surface.emissive;
  radiance += LocalLights(brdf, view, surface.position, surface.normal);
  if (with_sun) radiance += SunAtHit(surface, brdf, view);
  return radiance;
}

#endif
