// SPDX-License-Identifier: MIT
// The surface that a diffuse ray's closest-hit shader needs: it looks the same from all sides. What
// its material would mirror it spreads, so it keeps the material's energy. Normal textures are left
// out.
#ifndef KAAMOS_MATTE_SURFACE_HLSLI
#define KAAMOS_MATTE_SURFACE_HLSLI

#include "surface_brdf.hlsli"

struct MatteSurface {
  float3 position;  // as in Surface
  float offset;
  float3 normal;
  SpreadBrdf brdf;
  float3 emissive;
};

MatteSurface LoadMatteSurface(float2 barycentrics, float cone_width) {
  const TriangleHit hit = RayHit(barycentrics);
  const MaterialConstants material = materials[hit.layout.material_id];
  const HitPoint found = LoadHitPoint(vertices, indices, hit);
  HitTexel texel = NoTexel();
  if (HasAnyTexture(material)) texel = LoadHitTexel(vertices, hit, found, material, cone_width);
  MatteSurface surface;
  surface.position = found.spawn.position;
  surface.offset = found.spawn.offset;
  surface.normal = found.side * found.spawn.normal;
  float3 base_color =
      material.base_color.rgb * SampleMaterial(material, kBaseColorTexture, texel).rgb;
  surface.emissive = material.emissive * SampleMaterial(material, kEmissiveTexture, texel).rgb;
  const bool is_unlit = (material.flags & kMaterialUnlit) != 0;
  if (hit.layout.color_offset != 0) {
    const float3 color = LoadColor(vertices, hit.layout, found.corners, hit.barycentrics).rgb;
    base_color *= color;
    if (is_unlit) surface.emissive *= color;
  }
  surface.emissive = Contain(surface.emissive, kLargestRadiance);
  surface.brdf = MakeSpreadBrdf(0.0);
  if (!is_unlit) {
    const Reflectance reflectance = LoadReflectance(material, texel);
    const Brdf brdf =
        MakeBrdf(Contain(base_color, 1.0), reflectance.metallic, reflectance.roughness,
                 reflectance.dielectric_f0, reflectance.dielectric_f90);
    surface.brdf = MakeSpreadBrdf(brdf, surface.normal, -hit.direction);
  }
  return surface;
}

#endif
