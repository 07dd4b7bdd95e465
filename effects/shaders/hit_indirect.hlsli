// SPDX-License-Identifier: MIT
// Indirect light at what an effect's rays hit, from the volume.
#ifndef KAAMOS_HIT_INDIRECT_HLSLI
#define KAAMOS_HIT_INDIRECT_HLSLI

#include "hit_shading.hlsli"
#include "indirect_volume.hlsli"

// Of a surface that sends light everywhere alike. `jitter`: of VolumeTowards, here and below.
float3 IndirectAtMatteHit(MatteSurface surface, float3 jitter) {
  return surface.base_color * VolumeIrradianceAt(surface.position, jitter, surface.normal);
}

// Radiance towards where the ray came from. A metal has no diffuse light: it shows the volume's from
// where it mirrors, which is no picture, but keeps mirrors in mirrors from being black.
float3 IndirectAtHit(Surface surface, float3 jitter, float3 view) {
  float3 radiance = surface.base_color * (1.0 - surface.metallic) *
                    VolumeIrradianceAt(surface.position, jitter, surface.normal);
  if (surface.metallic > 0.0) {
    // Its roughness is the one that lights see: never quite 0.
    const Brdf brdf = MakeBrdf(surface.base_color, surface.metallic, surface.roughness);
    const float3 mirrored = reflect(-view, surface.shading_normal);
    radiance += surface.metallic *
                SpecularAlbedo(brdf.f0, sqrt(brdf.alpha), dot(surface.shading_normal, view)) *
                VolumeRadianceAt(surface.position, jitter, surface.normal, mirrored);
  }
  return radiance;
}

#endif
