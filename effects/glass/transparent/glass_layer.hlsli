// SPDX-License-Identifier: MIT
// Computes what a layer of glass sends to the camera and lets through, whether a ray met it or it
// is drawn.
#ifndef KAAMOS_GLASS_LAYER_HLSLI
#define KAAMOS_GLASS_LAYER_HLSLI

#include "hit_indirect.hlsli"

float3 Contain(float3 x) { return Contain(x, kLargestRadiance); }

float Coverage(float opacity) {
  if (!(opacity > 0.0)) return 0.0;
  return opacity < 1.0 ? opacity : 1.0;
}

// Light that a layer sends to the camera, apart from the mirror image. The caller provides the
// sun's visibility, because an any-hit shader cannot trace a ray.
float3 LayerLight(Surface surface, Brdf brdf, float3 direction, float sun_visibility) {
  if (surface.is_unlit) return surface.emissive;
  const BrdfView view = MakeBrdfView(brdf, surface.shading_normal, direction);
  float3 light = surface.emissive;
  light += LocalLights(brdf, view, surface.position, surface.normal);
  light += view.diffuse * VolumeIrradianceAt(surface.position, kEveryCell, surface.normal);
  if (sun_visibility > 0.0 && dot(surface.normal, frame.direction_to_sun) > 0.0) {
    light += frame.sun_irradiance * EvaluateBrdf(brdf, view, frame.direction_to_sun) *
             sun_visibility;
  }
  return light;
}

struct GlassLayer {
  float3 radiance;
  float3 transmittance;  // by colour
};

// Without a mirror image.
GlassLayer LitLayer(Surface surface, float coverage, float3 direction, float sun_visibility) {
  const Brdf brdf = SurfaceBrdf(surface);
  GlassLayer layer;
  layer.radiance = coverage * Contain(LayerLight(surface, brdf, -direction, sun_visibility));
  layer.transmittance = float3(1, 1, 1) * (1.0 - coverage);
  return layer;
}

// Adds what the layer mirrors: as much as glass does however little it covers (`in_full`), which
// lets that much less through; or only as far as it covers.
void AddMirrored(inout GlassLayer layer, Surface surface, float coverage, float3 direction,
                 float3 mirrored, bool in_full) {
  if (surface.is_unlit) return;
  const Brdf brdf = SurfaceBrdf(surface);
  const float3 fresnel = saturate(FresnelSchlick(brdf.f0, brdf.f90, -dot(direction, surface.shading_normal)));
  if (in_full) {
    layer.radiance += fresnel * mirrored;
    layer.transmittance *= float3(1, 1, 1) - fresnel;
  } else {
    layer.radiance += coverage * (fresnel * mirrored);
  }
  layer.radiance = Contain(layer.radiance);
}

#endif
