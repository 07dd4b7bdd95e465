// SPDX-License-Identifier: MIT
// Indirect light at a hit, read from the volume.
#ifndef KAAMOS_HIT_INDIRECT_HLSLI
#define KAAMOS_HIT_INDIRECT_HLSLI

#include "hit_shading.hlsli"
#include "indirect_volume.hlsli"

// For a surface that looks the same from all sides. `view`: where the ray came from. `jitter` here and below: see
// VolumeTowards.
float3 IndirectAtMatteHit(MatteSurface surface, float3 jitter, float3 view) {
  return SpreadAlbedo(surface.brdf, dot(surface.normal, view)) *
         VolumeIrradianceAt(surface.position, jitter, surface.normal);
}

// Radiance towards `view`, where the ray came from. The specular part shows the volume's light from
// the mirrored direction. That is too coarse for an image, but it keeps mirrors seen in mirrors from
// being black.
float3 IndirectAtHit(Surface surface, float3 jitter, float3 view) {
  if (surface.is_unlit) return float3(0, 0, 0);
  const BrdfView brdf_view =
      MakeBrdfView(SurfaceBrdf(surface), surface.shading_normal, view);
  const float3 mirrored = reflect(-view, surface.shading_normal);
  return brdf_view.diffuse * VolumeIrradianceAt(surface.position, jitter, surface.normal) +
         brdf_view.specular *
             VolumeRadianceAt(surface.position, jitter, surface.normal, mirrored);
}

#endif
