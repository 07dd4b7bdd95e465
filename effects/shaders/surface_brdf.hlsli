// SPDX-License-Identifier: MIT
// The material model at a surface that a ray hit.
#ifndef KAAMOS_SURFACE_BRDF_HLSLI
#define KAAMOS_SURFACE_BRDF_HLSLI

#include "brdf.hlsli"
#include "surface.hlsli"

Brdf SurfaceBrdf(Surface surface) {
  return MakeBrdf(surface.base_color, surface.metallic, surface.roughness, surface.dielectric_f0,
                  surface.dielectric_f90);
}

SpreadBrdf SurfaceSpreadBrdf(Surface surface, float3 view) {
  if (surface.is_unlit) return MakeSpreadBrdf(0.0);
  return MakeSpreadBrdf(SurfaceBrdf(surface), surface.normal, view);
}

#endif
