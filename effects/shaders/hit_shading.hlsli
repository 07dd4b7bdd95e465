// SPDX-License-Identifier: MIT
// The one way in which every effect shades what its rays hit: emitted light, local lights with their
// shadow maps, the sun by a ray of its own (no shadow map knows what the camera does not see), and
// indirect light. [Northlight deck: unified material; effects-spec B4.10]
#ifndef KAAMOS_HIT_SHADING_HLSLI
#define KAAMOS_HIT_SHADING_HLSLI

#include "hit_lighting.hlsli"
#include "surface.hlsli"
#include "visibility.hlsli"

// The sun's light by a surface, shadowed by one ray to its middle.
float3 SunAtHit(Surface surface, Brdf brdf, float3 view) {
  if (!(dot(surface.normal, frame.direction_to_sun) > 0.0)) return float3(0, 0, 0);
  const float3 unshadowed = frame.sun_irradiance *
                            EvaluateBrdf(brdf, surface.shading_normal, view, frame.direction_to_sun);
  if (!(RadianceLuminance(unshadowed) > 0.0)) return float3(0, 0, 0);
  return unshadowed * TraceVisibility(SurfaceOrigin(surface, frame.direction_to_sun),
                                      frame.direction_to_sun, kSunDistance);
}

// Radiance from a hit towards where the ray came from, without indirect light.
float3 ShadeHit(Surface surface, float3 view, bool with_sun) {
  const Brdf brdf = MakeBrdf(surface.base_color, surface.metallic, surface.roughness);
  float3 radiance = surface.emissive;
  radiance += LocalLights(brdf, surface.position, surface.normal, surface.shading_normal, view);
  if (with_sun) radiance += SunAtHit(surface, brdf, view);
  return radiance;
}

#endif
