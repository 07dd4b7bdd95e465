// SPDX-License-Identifier: MIT
// The materials' lobes against the integrals that make them physical.
#include <kaamos/test.hlsli>
#include "hair.hlsli"
#include "skin.hlsli"

// Point `i` of 64 x 64 on the whole sphere, of equal areas.
float3 on_sphere(uint i) {
  const float z = -1 + 2 * (float(i / 64) + 0.5) / 64;
  const float phi = 6.2831853 * (float(i % 64) + 0.5) / 64;
  return float3(sqrt(1 - z * z) * cos(phi), sqrt(1 - z * z) * sin(phi), z);
}
static const float kArea = 4 * 3.14159265 / 4096;

[test] void FresnelGoesFromF0ToF90() {
  const float3 f0 = float3(0.04, 0.5, 0.9);
  EXPECT_EQ(FresnelSchlick(f0, 1, 1), f0);
  EXPECT_NEAR(FresnelSchlick(f0, 1, 0), float3(1, 1, 1), 1e-6);
  EXPECT_NEAR(FresnelSchlick(f0, 0.5, 0), float3(0.5, 0.5, 0.5), 1e-6);
  EXPECT_NEAR(FresnelSchlick(0.04, 1, 0.5), 0.04 + 0.96 / 32, 1e-6);
}

// The microfacets' area, seen from above, is that of the surface.
[test]
[cases(0.2, 0.5, 1)]
void MicrofacetsCoverTheSurface(float alpha) {
  float sum = 0;
  [loop] for (uint i = 0; i < 256 * 256; ++i) {
    // By the square t2 of the tangent, in steps that are fine where the lobe is: its share is u.
    const float u = (float(i / 256) + 0.5) / 256;
    const float t2 = alpha * alpha * u / (1 - u);
    const float cosine = rsqrt(1 + t2);
    const float phi = 6.2831853 * (float(i % 256) + 0.5) / 256;
    const float sine = sqrt(saturate(1 - cosine * cosine));
    const float3 h = float3(sine * cos(phi), sine * sin(phi), cosine);
    // The solid angle of a step: pi cos^3 d(t2).
    const float solid_angle = 3.14159265 * cosine * cosine * cosine * alpha * alpha / ((1 - u) * (1 - u));
    sum += GgxDensity(alpha, float3(0, 0, 1), h) * cosine * solid_angle;
  }
  EXPECT_NEAR(sum / (256 * 256), 1, 1e-3);
}

// A direction mirrored at a sampled half vector carries at most the light that arrives.
[test]
[numthreads(64, 1, 1)]
void SampledReflectionsGainNothing(uint i : SV_GroupIndex) {
  const Brdf metal = MakeBrdf(float3(1, 1, 1), 1, 0.1 + 0.9 * float(i % 8) / 7);
  const float cosine = 0.05 + 0.9 * float(i / 8) / 7;
  const float3 view = float3(sqrt(1 - cosine * cosine), 0, cosine);
  [loop] for (uint k = 0; k < 64; ++k) {
    const float2 u = (float2(k % 8, k / 8) + 0.5) / 8;
    const float3 h = SampleGgxHalfVector(u, view, metal.alpha);
    EXPECT_NEAR(length(h), 1, 1e-5);
    EXPECT_LE(0, dot(view, h) + 1e-5);
    const float3 light = reflect(-view, h);
    EXPECT_LE(GgxSampleWeight(metal, view.z, light.z, dot(view, h)), 1.00001);
  }
}

[test] void MetalsHaveNoDiffusePart() {
  const Brdf metal = MakeBrdf(float3(0.8, 0.5, 0.2), 1, 0.5);
  EXPECT_EQ(metal.diffuse, float3(0, 0, 0));
  EXPECT_NEAR(metal.f0, float3(0.8, 0.5, 0.2), 1e-6);
  EXPECT_EQ(MakeBrdf(float3(0.8, 0.5, 0.2), 0, 0.5).f0, float3(0.04, 0.04, 0.04));
  EXPECT_EQ(MakeBrdf(float3(1, 1, 1), 0, 0).roughness, kMirrorRoughness);
  EXPECT_TRUE(IsMirror(0.03));
  EXPECT_FALSE(IsMirror(0.04));
}

// Skin only moves light beyond the horizon.
[test] void WrappedLightIsNoMore() {
  float3 sum = 0;
  [loop] for (uint i = 0; i < 4096; ++i) sum += WrappedCosine(on_sphere(i).z) * kArea;
  EXPECT_NEAR(sum, float3(3.14159265, 3.14159265, 3.14159265), 0.01);
  EXPECT_LT(0, WrappedCosine(-0.05));
  EXPECT_EQ(WrappedCosine(-0.5), float3(0, 0, 0));
}

// Each lobe around the fibre, and the Gaussian along it, is a density.
[test] void LobesOfHairAreDensities() {
  float3 around = 0;
  float along = 0;
  [loop] for (uint i = 0; i < 4096; ++i) {
    around += HairAround(cos(6.2831853 * (float(i) + 0.5) / 4096)) * (6.2831853 / 4096);
    along += HairAlong(-1 + 2 * (float(i) + 0.5) / 4096, 0.1) * (2.0 / 4096);
  }
  EXPECT_NEAR(around, float3(1, 1, 1), 1e-3);
  EXPECT_NEAR(along, 1, 1e-4);
}

// Light and view may change places, and white hair gives back no more than it gets.
[test]
[numthreads(64, 1, 1)]
void HairIsReciprocal(uint i : SV_GroupIndex) {
  const Brdf brdf = MakeBrdf(float3(0.5, 0.3, 0.1), 0, 0.4);
  const float3 fibre = normalize(float3(0.1, 1, 0.3));
  const float3 a = on_sphere(i * 61), b = on_sphere(i * 37 + 11);
  EXPECT_NEAR(EvaluateHair(brdf, fibre, a, b), EvaluateHair(brdf, fibre, b, a), 1e-5);
}

[test]
[cases((0, 1, 0), (1, 0, 0), (0.7, 0.7, 0))]
void HairMakesNoEnergy(float x, float y, float z) {
  const Brdf white = MakeBrdf(float3(1, 1, 1), 0, 0.5);
  float3 sum = 0;
  const float3 view = normalize(float3(x, y, z));
  [loop] for (uint i = 0; i < 4096; ++i) {
    sum += EvaluateHair(white, float3(0, 1, 0), view, on_sphere(i)) * kArea;
  }
  EXPECT_LE(sum, 1.05);
}
