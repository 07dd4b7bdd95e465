// SPDX-License-Identifier: MIT
// Bindless materials: constants in a structured buffer, textures in an unbounded array, and the
// material id in the hit record. [Northlight deck: Bindless Access to Materials] The layout is that
// of effects/assets/scene/material.h.
#ifndef KAAMOS_MATERIAL_HLSLI
#define KAAMOS_MATERIAL_HLSLI

static const uint kBaseColorTexture = 0u;
static const uint kMetallicRoughnessTexture = 1u;
static const uint kNormalTexture = 2u;
static const uint kEmissiveTexture = 3u;
static const uint kSpecularTexture = 4u;
static const uint kSpecularColorTexture = 5u;

static const uint kMaterialMask = 1u;
static const uint kMaterialBlend = 2u;
static const uint kMaterialDoubleSided = 4u;
static const uint kMaterialAlphaTested = 8u;
static const uint kMaterialUnlit = 16u;  // emits its base colour times the vertex colour

static const int kNoTexture = -1;

// 288 bytes. Colours are linear.
struct MaterialConstants {
  float4 base_color;
  float3 emissive;
  float metallic;
  float roughness;  // perceptual: alpha = roughness^2
  float alpha_cutoff;
  float normal_scale;
  uint flags;
  float3 specular_color;
  float specular;
  float dielectric_f0;
  uint second_uv;      // bit per slot: read with the second texture coordinates
  int image[6];        // into the texture array, or kNoTexture
  uint sampler_id[6];  // into the sampler array
  float4 uv_matrix[6];
  float2 uv_offset[6];
  float one_texel_level[6];  // level of detail at which a texture is one texel
};

bool HasTexture(MaterialConstants material, uint slot) { return material.image[slot] >= 0; }

bool HasAnyTexture(MaterialConstants material) {
  return max(max(max(material.image[0], material.image[1]),
                 max(material.image[2], material.image[3])),
             max(material.image[4], material.image[5])) >= 0;
}

bool UsesSecondUv(MaterialConstants material, uint slot) {
  return (material.second_uv & (1u << slot)) != 0u;
}

// Texture coordinates of a slot. [KHR_texture_transform]
float2 MaterialUv(MaterialConstants material, uint slot, float2 uv) {
  const float4 m = material.uv_matrix[slot];
  return float2(m.x * uv.x + m.y * uv.y, m.z * uv.x + m.w * uv.y) + material.uv_offset[slot];
}

// Tells an any-hit shader whether there is a hole: `texture_alpha` is 1 where the material has no
// base colour texture.
bool IsOpen(MaterialConstants material, float texture_alpha) {
  return (material.flags & kMaterialAlphaTested) != 0u &&
         material.base_color.w * texture_alpha < material.alpha_cutoff;
}

// Shading normal in world space from a texel of the normal texture. `normal` and `tangent` are unit
// vectors of world space, `handedness` is +1 or -1.
float3 ApplyNormalTexture(float3 texel, float normal_scale, float3 normal, float3 tangent,
                          float handedness) {
  const float3 local = texel * 2.0f - 1.0f;
  const float3 bitangent = handedness * cross(normal, tangent);
  const float3 bent = (tangent * local.x + bitangent * local.y) * normal_scale + normal * local.z;
  const float length_squared = dot(bent, bent);
  return length_squared > 0.0f ? bent / sqrt(length_squared) : normal;
}

#endif
