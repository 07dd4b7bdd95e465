// SPDX-License-Identifier: MIT
// The one material model, used at every hit: GGX, and Lambert for the light that GGX leaves.
// [Northlight deck: unified simplified PBR] Vectors have unit length and point away from the
// surface.
#ifndef KAAMOS_BRDF_HLSLI
#define KAAMOS_BRDF_HLSLI

#include "frame.hlsli"

static const float kBrdfPi = 3.14159265f;
// Smoother surfaces are treated as mirrors: the peak of GGX would exceed the range of floats.
static const float kMirrorRoughness = 0.03f;

struct Brdf {
  float3 diffuse;   // albedo of the diffuse part, were there no specular part
  float3 f0;        // reflectance at normal incidence
  float f90;        // and of light that grazes the surface
  float roughness;  // at least kMirrorRoughness
  float alpha;      // GGX: roughness squared
};

// A mirror shows lamps by their shapes, which its rays meet (kMaskSolid). Every other surface
// evaluates them as lights, and its rays pass through the shapes (kMaskWithoutLamps).
bool IsMirror(float roughness) { return roughness <= kMirrorRoughness; }
uint ReflectionMask(float roughness) {
  return IsMirror(roughness) ? kMaskSolid : kMaskWithoutLamps;
}

// `dielectric_f0` and `dielectric_f90`: reflectance where it is no metal.
Brdf MakeBrdf(float3 base_color, float metallic, float roughness, float3 dielectric_f0,
              float dielectric_f90) {
  Brdf result;
  result.diffuse = base_color * (1.0f - metallic);
  result.f0 = lerp(dielectric_f0, base_color, metallic);
  result.f90 = lerp(dielectric_f90, 1.0f, metallic);
  result.roughness = clamp(roughness, kMirrorRoughness, 1.0f);
  result.alpha = result.roughness * result.roughness;
  return result;
}

// With the reflectance of glass.
Brdf MakeBrdf(float3 base_color, float metallic, float roughness) {
  return MakeBrdf(base_color, metallic, roughness, float3(0.04f, 0.04f, 0.04f), 1.0f);
}

// That of a pixel of the G-buffer. [encoding.hlsli: EncodeDielectric]
Brdf PixelBrdf(uint2 pixel) {
  const float4 material = g_material[pixel];
  float3 f0 = float3(0.04f, 0.04f, 0.04f);
  float f90 = 1.0f;
  if (!IsPlainDielectric(material)) {
    DecodeDielectric(material, IsTinted(material) ? g_emissive[pixel].w : kNoTint, f0, f90);
  }
  return MakeBrdf(DecodeColor(g_base_color[pixel].rgb), material.y, material.x, f0, f90);
}

// [Schlick 1994]
float3 FresnelSchlick(float3 f0, float f90, float cosine) {
  const float m = saturate(1.0f - cosine);
  const float m2 = m * m;
  return f0 + (float3(f90, f90, f90) - f0) * (m2 * m2 * m);
}

// From the sine of the half vector's angle, not from 1 - cosine squared, of which rounding leaves
// nothing at the peak of a smooth lobe.
float GgxDensity(float alpha, float3 normal, float3 half_vector) {
  const float a2 = alpha * alpha;
  const float cosine = dot(normal, half_vector);
  const float3 beside = cross(normal, half_vector);
  const float d = cosine * cosine * a2 + dot(beside, beside);
  return a2 / (kBrdfPi * d * d);
}

// cosine * (1 + 2 Lambda) with Smith's Lambda, written without a division, which would fail at
// grazing angles.
float GgxShadowing(float alpha, float cosine) {
  const float a2 = alpha * alpha;
  return sqrt(a2 + (1.0f - a2) * (cosine * cosine));
}

// Reflectance of the specular part under uniform light, without multiple scattering: interpolated
// from effects/assets/common/specular_albedo.h's table. `roughness` is 0 to 1.
float3 SpecularAlbedo(float3 f0, float f90, float roughness, float cosine_view) {
  const float2 at = float2(sqrt(saturate(cosine_view)) * float(kSpecularAlbedoCosines - 1),
                           saturate(roughness) * float(kSpecularAlbedoRoughnesses - 1));
  const uint2 corner = min(uint2(at), uint2(kSpecularAlbedoCosines, kSpecularAlbedoRoughnesses) - 2);
  const float2 part = at - float2(corner);
  const uint first = corner.y * kSpecularAlbedoCosines + corner.x;
  const float2 smoother =
      lerp(specular_albedo_table[first], specular_albedo_table[first + 1], part.x);
  const float2 rougher =
      lerp(specular_albedo_table[first + kSpecularAlbedoCosines],
           specular_albedo_table[first + kSpecularAlbedoCosines + 1], part.x);
  const float2 split = lerp(smoother, rougher, part.y);
  return f0 * split.x + f90 * split.y;
}

// Returns what a reflection is divided by before a filter, and multiplied by afterwards: the
// specular albedo, but never so little that the quotient overflows.
float3 ReflectionScale(float3 specular_albedo) {
  return max(specular_albedo, float3(0.001f, 0.001f, 0.001f));
}

// The view direction at a surface, and the part of its reflectance that all lights share.
struct BrdfView {
  float3 normal;
  float3 direction;  // towards the eye
  float cosine;      // with the normal; at least 1e-4
  float shadowing;   // GgxShadowing of the view direction
  float3 specular;   // SpecularAlbedo
  float3 diffuse;    // albedo of the diffuse part, which has the light that the specular leaves
};

BrdfView MakeBrdfView(Brdf brdf, float3 normal, float3 direction) {
  BrdfView view;
  view.normal = normal;
  view.direction = direction;
  view.cosine = max(dot(normal, direction), 1e-4f);
  view.shadowing = GgxShadowing(brdf.alpha, view.cosine);
  view.specular = SpecularAlbedo(brdf.f0, brdf.f90, brdf.roughness, view.cosine);
  view.diffuse = brdf.diffuse * (float3(1.0f, 1.0f, 1.0f) - view.specular);
  return view;
}

// A surface that sends what it reflects to all sides alike, with the energy of its material: it
// spreads the light that the material would mirror. For light that is too coarse for a picture in a
// mirror.
struct SpreadBrdf {
  float3 diffuse;  // BrdfView's
  float roughness;
  float3 f0;       // Brdf's; f90 too
  float f90;
};

SpreadBrdf MakeSpreadBrdf(Brdf brdf, float3 normal, float3 view) {
  SpreadBrdf result;
  result.diffuse = MakeBrdfView(brdf, normal, view).diffuse;
  result.roughness = brdf.roughness;
  result.f0 = brdf.f0;
  result.f90 = brdf.f90;
  return result;
}

// White paper (1) or nothing that reflects (0).
SpreadBrdf MakeSpreadBrdf(float albedo) {
  SpreadBrdf result;
  result.diffuse = float3(albedo, albedo, albedo);
  result.roughness = 1.0f;
  result.f0 = float3(0.0f, 0.0f, 0.0f);
  result.f90 = 0.0f;
  return result;
}

// The share that is reflected of light whose direction has this cosine with the normal. By
// reciprocity, with the cosine of the view it is the share of uniform light that is seen.
float3 SpreadAlbedo(SpreadBrdf brdf, float cosine) {
  return brdf.diffuse + SpecularAlbedo(brdf.f0, brdf.f90, brdf.roughness, cosine);
}

// BRDF times cosine: the radiance sent towards `view` per unit of irradiance (measured facing the
// light) from direction `light`. The specular part is GGX's density times Smith's height-correlated
// visibility, whose divisor 4 n_v n_l (1 + Lambda(n_v) + Lambda(n_l)) is twice `both`.
float3 EvaluateBrdf(Brdf brdf, BrdfView view, float3 light) {
  const float n_l = dot(view.normal, light);
  if (!(n_l > 0.0f)) return float3(0.0f, 0.0f, 0.0f);
  const float3 half_vector = normalize(view.direction + light);
  const float3 fresnel = FresnelSchlick(brdf.f0, brdf.f90, dot(view.direction, half_vector));
  const float both = n_l * view.shadowing + view.cosine * GgxShadowing(brdf.alpha, n_l);
  const float specular =
      GgxDensity(brdf.alpha, view.normal, half_vector) / (2.0f * both);
  return (view.diffuse * (1.0f / kBrdfPi) + fresnel * specular) * n_l;
}

// EvaluateBrdf for the direction of a lamp, which a mirror shows by its shape instead.
float3 EvaluateBrdfForLamp(Brdf brdf, BrdfView view, float3 light) {
  if (!IsMirror(brdf.roughness)) return EvaluateBrdf(brdf, view, light);
  return view.diffuse * (max(dot(view.normal, light), 0.0f) * (1.0f / kBrdfPi));
}

// Samples a half vector about +Z with the density of the GGX microfacets that `view` sees: map
// `view` to the hemisphere configuration, sample a spherical cap, map back. [Dupuy & Benyoub 2023,
// Sampling Visible GGX Normals with Spherical Caps]
float3 SampleGgxHalfVector(float2 u, float3 view, float alpha) {
  const float3 w = normalize(float3(alpha * view.x, alpha * view.y, view.z));
  const float phi = 2.0f * kBrdfPi * u.x;
  const float z = (1.0f - u.y) * (1.0f + w.z) - w.z;
  const float s = sqrt(saturate(1.0f - z * z));
  const float3 h = float3(s * cos(phi), s * sin(phi), z) + w;
  return normalize(float3(alpha * h.x, alpha * h.y, max(h.z, 0.0f)));
}

// BRDF times cosine over density for a direction mirrored at such a half vector: F G2 / G1, which
// is F (1 + Lambda(n_v)) / (1 + Lambda(n_v) + Lambda(n_l)), at most 1. It is zero below the
// surface: that light is lost rather than sampled again. [Heitz 2018]
float3 GgxSampleWeight(Brdf brdf, float cosine_view, float cosine_light, float cosine_half_view) {
  if (!(cosine_light > 0.0f)) return float3(0.0f, 0.0f, 0.0f);
  const float view = GgxShadowing(brdf.alpha, cosine_view);
  const float light = GgxShadowing(brdf.alpha, cosine_light);
  return FresnelSchlick(brdf.f0, brdf.f90, cosine_half_view) *
         (cosine_light * (view + cosine_view) / (cosine_light * view + cosine_view * light));
}

#endif
