// SPDX-License-Identifier: MIT
// Indirect light at a hit, read from the volume.
#ifndef KAAMOS_HIT_INDIRECT_HLSLI
#define KAAMOS_HIT_INDIRECT_HLSLI

#include "hit_shading.hlsli"
#include "indirect_volume.hlsli"

// For a surface that reflects the same in all directions. `jitter` here and below: see
// VolumeTowards.
float3 IndirectAtMatteHit(MatteSurface surface, float3 jitter) {
  return surface.base_color * VolumeIrradianceAt(surface.position, jitter, surface.normal);
}

// Radiance towards `view`, where the ray came from. A metal reflects no diffuse light, so it shows
// the volume's light from the mirrored direction. That is too coarse for an image, but it keeps
// mirrors seen in mirrors from being black.
float3 IndirectAtHit(Surface surface, float3 jitter, float3 view) {
  float3 radiance = surface.base_color * (1.0 - surface.metallic) *
                    VolumeIrradianceAt(surface.position, jitter, surface.normal);
  if (surface.metallic > 0.0) {
    // The roughness as lights see it, which is never quite 0.
    const Brdf brdf = MakeBrdf(surface.base_color, surface.metallic, surface.roughness);
    const float3 mirrored = reflect(-view, surface.shading_normal);
    radiance += surface.metallic *
                SpecularAlbedo(brdf.f0, sqrt(brdf.alpha), dot(surface.shading_normal, view)) *
                VolumeRadianceAt(surface.position, jitter, surface.normal, mirrored);
  }
  return radiance;
}

#endif
