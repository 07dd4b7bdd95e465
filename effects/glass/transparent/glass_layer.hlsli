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

// Light that a layer sends to the camera, apart from the sun's and the mirror image.
float3 LayerLight(Surface surface, Brdf brdf, float3 direction) {
  if (surface.is_unlit) return surface.emissive;
  const BrdfView view = MakeBrdfView(brdf, surface.shading_normal, direction);
  return surface.emissive + LocalLights(brdf, view, surface.position, surface.normal) +
         view.diffuse * VolumeIrradianceAt(surface.position, kEveryCell, surface.normal);
}

// The sun's light that a layer sends to the camera where nothing is in its way. The caller tells
// whether that is so, because an any-hit shader cannot trace a ray.
float3 LayerSunlight(Surface surface, Brdf brdf, float3 direction) {
  if (surface.is_unlit || !(dot(surface.normal, frame.direction_to_sun) > 0.0)) {
    return float3(0, 0, 0);
  }
  const BrdfView view = MakeBrdfView(brdf, surface.shading_normal, direction);
  return frame.sun_irradiance * EvaluateBrdf(brdf, view, frame.direction_to_sun);
}

struct GlassLayer {
  float3 radiance;
  float3 transmittance;  // by colour
};

// Without a mirror image.
GlassLayer LitLayer(Surface surface, float coverage, float3 direction, float sun_visibility) {
  const Brdf brdf = SurfaceBrdf(surface);
  GlassLayer layer;
  float3 light = LayerLight(surface, brdf, -direction);
  if (sun_visibility > 0.0) light += LayerSunlight(surface, brdf, -direction) * sun_visibility;
  layer.radiance = coverage * Contain(light);
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
