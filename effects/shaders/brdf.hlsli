// SPDX-License-Identifier: MIT
// The one material model of every hit: Lambert and GGX. [Northlight deck: unified simplified PBR]
// Vectors are unit and point away from the surface. [effects-spec B0.4]
#ifndef KAAMOS_BRDF_HLSLI
#define KAAMOS_BRDF_HLSLI

static const float kBrdfPi = 3.14159265f;
// Below this roughness a surface is a mirror: GGX's peak would leave the range of floats.
static const float kMirrorRoughness = 0.03f;

struct Brdf {
  float3 diffuse;  // albedo of the diffuse part
  float3 f0;       // reflectance at normal incidence
  float alpha;     // GGX: roughness squared
};

Brdf MakeBrdf(float3 base_color, float metallic, float roughness) {
  Brdf result;
  result.diffuse = base_color * (1.0f - metallic);
  result.f0 = lerp(float3(0.04f, 0.04f, 0.04f), base_color, metallic);
  const float clamped = clamp(roughness, kMirrorRoughness, 1.0f);
  result.alpha = clamped * clamped;
  return result;
}

// [Schlick 1994]
float3 FresnelSchlick(float3 f0, float cosine) {
  const float m = saturate(1.0f - cosine);
  const float m2 = m * m;
  return f0 + (float3(1.0f, 1.0f, 1.0f) - f0) * (m2 * m2 * m);
}

float GgxDensity(float alpha, float cosine_half) {
  const float a2 = alpha * alpha;
  const float d = cosine_half * cosine_half * (a2 - 1.0f) + 1.0f;
  return a2 / (kBrdfPi * d * d);
}

// cosine * (1 + 2 Lambda), Lambda as of Smith, without a division that fails at grazing angles.
float GgxShadowing(float alpha, float cosine) {
  const float a2 = alpha * alpha;
  return sqrt(a2 + (1.0f - a2) * (cosine * cosine));
}

// Where a surface is seen from, and what of its reflectance all lights have in common.
struct BrdfView {
  float3 normal;
  float3 direction;  // towards the eye
  float cosine;      // with the normal, a little above 0 at least
  float shadowing;   // GgxShadowing of that
};

BrdfView MakeBrdfView(Brdf brdf, float3 normal, float3 direction) {
  BrdfView view;
  view.normal = normal;
  view.direction = direction;
  view.cosine = max(dot(normal, direction), 1e-4f);
  view.shadowing = GgxShadowing(brdf.alpha, view.cosine);
  return view;
}

// Reflectance times cosine: what a surface sends towards `view` of irradiance 1 that arrives, on a
// surface that faces it, from `light`. GGX's density times Smith's visibility, whose divisor, 4 n_v
// n_l (1 + Lambda(n_v) + Lambda(n_l)), is that of both directions' shadowing.
float3 EvaluateBrdf(Brdf brdf, BrdfView view, float3 light) {
  const float n_l = dot(view.normal, light);
  if (!(n_l > 0.0f)) return float3(0.0f, 0.0f, 0.0f);
  const float3 half_vector = normalize(view.direction + light);
  const float3 fresnel = FresnelSchlick(brdf.f0, dot(view.direction, half_vector));
  const float both = n_l * view.shadowing + view.cosine * GgxShadowing(brdf.alpha, n_l);
  const float specular =
      GgxDensity(brdf.alpha, saturate(dot(view.normal, half_vector))) / (2.0f * both);
  return (brdf.diffuse * (1.0f / kBrdfPi) + fresnel * specular) * n_l;
}

// A half vector with the density that GGX's facets have as seen from `view`, all about +Z.
// [Dupuy & Benyoub 2023, spherical caps]
float3 SampleGgxHalfVector(float2 u, float3 view, float alpha) {
  const float3 w = normalize(float3(alpha * view.x, alpha * view.y, view.z));
  const float phi = 2.0f * kBrdfPi * u.x;
  const float z = (1.0f - u.y) * (1.0f + w.z) - w.z;
  const float s = sqrt(saturate(1.0f - z * z));
  const float3 h = float3(s * cos(phi), s * sin(phi), z) + w;
  return normalize(float3(alpha * h.x, alpha * h.y, max(h.z, 0.0f)));
}

// Reflectance over density of a direction that was mirrored at such a half vector: F G2 / G1, which is
// F (1 + Lambda(n_v)) / (1 + Lambda(n_v) + Lambda(n_l)). At most 1. Zero under the surface: that light
// is lost, not drawn anew. [effects-spec B0.4]
float3 GgxSampleWeight(Brdf brdf, float cosine_view, float cosine_light, float cosine_half_view) {
  if (!(cosine_light > 0.0f)) return float3(0.0f, 0.0f, 0.0f);
  const float view = GgxShadowing(brdf.alpha, cosine_view);
  const float light = GgxShadowing(brdf.alpha, cosine_light);
  return FresnelSchlick(brdf.f0, cosine_half_view) *
         (cosine_light * (view + cosine_view) / (cosine_light * view + cosine_view * light));
}

// Reflectance of the specular part under light from everywhere, about: what a signal is divided by
// before a filter and multiplied with behind it, so that only its ratio to the truth matters little.
// [Karis 2014, after Lazarov 2013]
float3 SpecularAlbedo(float3 f0, float roughness, float cosine_view) {
  const float4 c0 = float4(-1.0f, -0.0275f, -0.572f, 0.022f);
  const float4 c1 = float4(1.0f, 0.0425f, 1.04f, -0.04f);
  const float4 r = roughness * c0 + c1;
  const float a = min(r.x * r.x, exp2(-9.28f * saturate(cosine_view))) * r.x + r.y;
  return max(f0 * (-1.04f * a + r.z) + float3(1.0f, 1.0f, 1.0f) * (1.04f * a + r.w),
             float3(0.001f, 0.001f, 0.001f));
}

#endif
