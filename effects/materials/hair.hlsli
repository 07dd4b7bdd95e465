// SPDX-License-Identifier: MIT
// Hair: fibres that reflect at their surface (R), let light through (TT), and mirror it at their back
// (TRT), each along a cone about the fibre. [Marschner et al. 2003; with Gaussians of the sines:
// Karis 2016, Physically Based Hair Shading in Unreal]
#ifndef KAAMOS_HAIR_HLSLI
#define KAAMOS_HAIR_HLSLI

#include "brdf.hlsli"

static const float kHairTilt = 0.035;  // of a fibre's scales: they shift the cones

// A Gaussian, whose integral is 1.
float HairAlong(float x, float width) {
  return exp(-0.5 * x * x / (width * width)) / (width * 2.5066283);
}

// Densities over the angle around the fibre between view and light, by its cosine. The integral of
// each is 1: they come from 0.25 cos(angle / 2), exp(-3.65 cosine) and exp(17 cosine).
float3 HairAround(float cosine) {
  return float3(0.25 * sqrt(saturate(0.5 + 0.5 * cosine)), exp(-3.65 * cosine) / 52.622397,
                exp(17.0 * (cosine - 1.0)) / 0.612575);
}

// Fresnel's mean over the first of these: 31 / 3 - 105 pi / 32 of the way from f0 to f90. What is not
// reflected goes in, and by the same share it comes out again: lobes together make no energy.
float3 HairMeanFresnel(Brdf brdf) {
  return brdf.f0 + (float3(1, 1, 1) * brdf.f90 - brdf.f0) * 0.024980;
}

// The radiance sent towards the view per unit of irradiance, measured facing the light: the fibre
// has no normal. Symmetric in view and light; divided by the cosine of the light's angle to the
// fibre, as a BRDF would have it, it is not.
float3 EvaluateHair(Brdf brdf, float3 fibre, float3 view, float3 light) {
  const float sine_view = dot(fibre, view), sine_light = dot(fibre, light);
  const float3 across_view = view - sine_view * fibre, across_light = light - sine_light * fibre;
  const float lengths = dot(across_view, across_view) * dot(across_light, across_light);
  const float around = dot(across_view, across_light) * rsqrt(max(lengths, 1e-12));
  const float3 lobes = HairAround(clamp(around, -1.0, 1.0));
  const float width = brdf.alpha;
  const float sines = sine_view + sine_light;
  // By the angle around the fibre alone, so that its mean is the same for every light.
  const float half_cosine = sqrt(saturate(0.5 + 0.5 * around));
  const float3 surface = FresnelSchlick(brdf.f0, brdf.f90, half_cosine);
  const float3 mean = HairMeanFresnel(brdf);
  const float3 through = (1.0 - mean) * (1.0 - mean);
  return surface * (HairAlong(sines + 2.0 * kHairTilt, width) * lobes.x) +
         through * brdf.diffuse * (HairAlong(sines - kHairTilt, 0.5 * width) * lobes.y) +
         through * mean * brdf.diffuse * brdf.diffuse *
             (HairAlong(sines - 4.0 * kHairTilt, 2.0 * width) * lobes.z);
}

#endif
