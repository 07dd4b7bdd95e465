// SPDX-License-Identifier: MIT
// Loads what is known about the surface at a point of a triangle: one that a ray hit, or one that a
// pixel of a visibility buffer shows. G-buffer, reflections and indirect light all read it here.
#ifndef KAAMOS_SURFACE_HLSLI
#define KAAMOS_SURFACE_HLSLI

#include "frame.hlsli"

static const float kLargestRadiance = 65504.0;  // the largest half float

struct Surface {
  float3 position;        // relative to the camera
  float offset;           // along `normal`: a ray that starts this far off misses its own surface
  float3 normal;          // of the triangle, towards the ray's origin
  float3 shading_normal;  // also towards the ray's origin
  float3 base_color;      // linear, 0..1; metallic and roughness too
  float opacity;
  float3 emissive;
  float roughness;
  float metallic;
  float3 dielectric_f0;  // reflectance of what is no metal: of light that comes straight at it
  float dielectric_f90;  // and of light that grazes it
  bool back_face;  // the ray hit the back of the triangle
  bool is_unlit;   // emits its base colour and reflects nothing [KHR_materials_unlit]
};

static const float kFinestLevel = -1e30;

// Samples a texture of the material; 1 if it has none. `level` is relative to the level of detail
// at which the texture is one texel; kFinestLevel reads level 0.
float4 SampleMaterial(MaterialConstants material, uint slot, float2 uv, float level) {
  if (!HasTexture(material, slot)) {
    return float4(1, 1, 1, 1);
  }
  const uint image = material.image[slot];
  const uint sampler_id = material.sampler_id[slot];
  return textures[NonUniformResourceIndex(image)].SampleLevel(
      samplers[NonUniformResourceIndex(sampler_id)], MaterialUv(material, slot, uv),
      max(0.0, material.one_texel_level[slot] + level));
}

// Level of detail of every texture on a triangle for a ray cone `width` metres wide at the hit,
// relative to the level at which the texture is one texel: half the log2 of the fraction of the
// texture that the cone covers. [Akenine-Moller et al. 2019, Texture Level of Detail Strategies for
// Real-Time Ray Tracing]
float RayConeLevel(float3 p0, float3 p1, float3 p2, float2 uv0, float2 uv1, float2 uv2,
                   float3x3 to_world, float facing, float width) {
  const float world_area = length(cross(mul(to_world, p1 - p0), mul(to_world, p2 - p0)));
  const float2 a = uv1 - uv0;
  const float2 b = uv2 - uv0;
  const float uv_area = abs(a.x * b.y - a.y * b.x);
  const float slant = max(facing, 0.05);
  return 0.5 * log2(uv_area * (width * width) / (max(world_area, 1e-20) * (slant * slant)));
}

// Width of the pixel's cone at the hit, in metres. For a secondary ray, its origin's distance from
// the camera counts too: a flat mirror shows things at the size they have at the total distance.
float ConeWidth() {
  const float way = length(WorldRayOrigin()) + RayTCurrent() * length(WorldRayDirection());
  return ConeWidthAfter(way);
}

// A point of a triangle and who looks at it. Its vertices and indices are handed on besides.
struct TriangleHit {
  HitConstants layout;  // of the triangle's geometry
  uint primitive;
  float2 barycentrics;  // weights of the second and third vertex
  float3x4 object_to_world;
  float3x4 world_to_object;
  float3 direction;  // towards the point, unit
};

// That of the hit shader that calls this.
TriangleHit RayHit(float2 barycentrics) {
  TriangleHit hit;
  hit.layout = hit_constants;
  hit.primitive = PrimitiveIndex();
  hit.barycentrics = barycentrics;
  hit.object_to_world = ObjectToWorld3x4();
  hit.world_to_object = WorldToObject3x4();
  hit.direction = normalize(WorldRayDirection());
  return hit;
}

// The triangle that was hit and the point on it, seen from the side that the ray comes from.
struct HitPoint {
  uint3 corners;  // vertex numbers
  float3 p0;      // vertex positions, object space
  float3 p1;
  float3 p2;
  SpawnPoint spawn;  // `spawn.normal` is the triangle's own
  float side;        // 1: the ray came from the normal's side; -1: from the back
};

HitPoint LoadHitPoint(ByteAddressBuffer vertices, ByteAddressBuffer indices, TriangleHit hit) {
  const uint stride = hit.layout.vertex_stride;
  HitPoint found;
  found.corners = LoadTriangle(indices, hit.layout.index_size_bytes, hit.primitive);
  found.p0 = LoadVertexFloat3(vertices, stride, 0, found.corners.x);
  found.p1 = LoadVertexFloat3(vertices, stride, 0, found.corners.y);
  found.p2 = LoadVertexFloat3(vertices, stride, 0, found.corners.z);
  found.spawn = MakeSpawnPoint(found.p0, found.p1, found.p2, hit.barycentrics, hit.object_to_world,
                               hit.world_to_object);
  found.side = dot(hit.direction, found.spawn.normal) <= 0.0 ? 1.0 : -1.0;
  return found;
}

// The places where textures are read at a hit, and their levels of detail.
struct HitTexel {
  float2 uv;
  float level;
  float2 second_uv;  // as uv, where the material reads no texture with it
  float second_level;
};

// The same for one pair of texture coordinates.
void LoadTexelOf(ByteAddressBuffer vertices, TriangleHit hit, HitPoint found, float cone_width,
                 bool second, out float2 uv, out float level) {
  const HitConstants layout = hit.layout;
  const uint offset = UvOffset(layout, second);
  const float2 uv0 = LoadVertexFloat2(vertices, layout.vertex_stride, offset, found.corners.x);
  const float2 uv1 = LoadVertexFloat2(vertices, layout.vertex_stride, offset, found.corners.y);
  const float2 uv2 = LoadVertexFloat2(vertices, layout.vertex_stride, offset, found.corners.z);
  uv = Interpolate(uv0, uv1, uv2, hit.barycentrics);
  level = kFinestLevel;
  if (cone_width > 0.0) {
    level = RayConeLevel(found.p0, found.p1, found.p2, uv0, uv1, uv2,
                         (float3x3)hit.object_to_world,
                         abs(dot(hit.direction, found.spawn.normal)), cone_width);
  }
}

// `cone_width` is the width of the ray's cone at the hit in metres; 0 reads level 0. [Northlight
// deck: texture LOD]
HitTexel LoadHitTexel(ByteAddressBuffer vertices, TriangleHit hit, HitPoint found,
                      MaterialConstants material, float cone_width) {
  HitTexel texel;
  LoadTexelOf(vertices, hit, found, cone_width, false, texel.uv, texel.level);
  texel.second_uv = texel.uv;
  texel.second_level = texel.level;
  if (material.second_uv != 0) {
    LoadTexelOf(vertices, hit, found, cone_width, true, texel.second_uv, texel.second_level);
  }
  return texel;
}

HitTexel NoTexel() {
  HitTexel texel;
  texel.uv = texel.second_uv = float2(0, 0);
  texel.level = texel.second_level = kFinestLevel;
  return texel;
}

float4 SampleMaterial(MaterialConstants material, uint slot, HitTexel texel) {
  const bool second = UsesSecondUv(material, slot);
  return SampleMaterial(material, slot, second ? texel.second_uv : texel.uv,
                        second ? texel.second_level : texel.level);
}

// How a material reflects, but for its colour; as in Surface.
struct Reflectance {
  float roughness;
  float metallic;
  float3 dielectric_f0;
  float dielectric_f90;
};

Reflectance LoadReflectance(MaterialConstants material, HitTexel texel) {
  Reflectance result;
  const float4 metallic_roughness = SampleMaterial(material, kMetallicRoughnessTexture, texel);
  result.roughness = Contain(material.roughness * metallic_roughness.g, 1.0);
  result.metallic = Contain(material.metallic * metallic_roughness.b, 1.0);
  // [KHR_materials_specular]
  result.dielectric_f90 =
      Contain(material.specular * SampleMaterial(material, kSpecularTexture, texel).a, 1.0);
  const float3 specular_color =
      material.specular_color * SampleMaterial(material, kSpecularColorTexture, texel).rgb;
  result.dielectric_f0 =
      result.dielectric_f90 * Contain(material.dielectric_f0 * specular_color, 1.0);
  return result;
}

// `cone_width`: as in LoadHitTexel.
Surface LoadSurface(ByteAddressBuffer vertices, ByteAddressBuffer indices, TriangleHit hit,
                    float cone_width) {
  const MaterialConstants material = materials[hit.layout.material_id];
  const HitPoint found = LoadHitPoint(vertices, indices, hit);
  Surface surface;
  surface.position = found.spawn.position;
  surface.offset = found.spawn.offset;
  surface.normal = found.side * found.spawn.normal;
  surface.back_face = found.side < 0.0;
  surface.is_unlit = (material.flags & kMaterialUnlit) != 0;
  HitTexel texel = NoTexel();
  if (HasAnyTexture(material)) texel = LoadHitTexel(vertices, hit, found, material, cone_width);

  float3 shading_normal = NormalToWorld(
      LoadNormal(vertices, hit.layout, found.corners, hit.barycentrics), hit.world_to_object);
  if (HasTexture(material, kNormalTexture)) {
    const float4 tangent = LoadTangent(vertices, hit.layout, found.corners, hit.barycentrics);
    const float3 world_tangent = normalize(mul((float3x3)hit.object_to_world, tangent.xyz));
    shading_normal =
        ApplyNormalTexture(SampleMaterial(material, kNormalTexture, texel).xyz,
                           material.normal_scale, shading_normal, world_tangent, tangent.w);
  }
  shading_normal *= dot(shading_normal, found.spawn.normal) * found.side >= 0.0 ? 1.0 : -1.0;
  // A shading normal that faces away from the ray's origin would reflect no visible light.
  surface.shading_normal = dot(shading_normal, hit.direction) < 0.0 ? shading_normal : surface.normal;

  float4 base_color =
      material.base_color * SampleMaterial(material, kBaseColorTexture, texel);
  float3 emissive =
      material.emissive * SampleMaterial(material, kEmissiveTexture, texel).rgb;
  if (hit.layout.color_offset != 0) {
    const float4 color = LoadColor(vertices, hit.layout, found.corners, hit.barycentrics);
    base_color *= color;
    if (surface.is_unlit) emissive *= color.rgb;
  }
  const Reflectance reflectance = LoadReflectance(material, texel);
  surface.base_color = Contain(base_color.rgb, 1.0);
  surface.opacity = base_color.a;
  surface.emissive = Contain(emissive, kLargestRadiance);
  surface.roughness = reflectance.roughness;
  surface.metallic = reflectance.metallic;
  surface.dielectric_f0 = reflectance.dielectric_f0;
  surface.dielectric_f90 = reflectance.dielectric_f90;
  return surface;
}

// The surface that a ray hit.
Surface LoadSurface(float2 barycentrics, float cone_width) {
  return LoadSurface(vertices, indices, RayHit(barycentrics), cone_width);
}

// Returns where a ray towards `direction` starts: on that side of the surface.
float3 SurfaceOrigin(Surface surface, float3 direction) {
  const float side = dot(surface.normal, direction) >= 0.0 ? 1.0 : -1.0;
  return surface.position + surface.normal * (side * surface.offset);
}

#endif
