// SPDX-License-Identifier: MIT
// An eye: a ball of radius 1 that looks along its +Z, whose clear cornea lies over a flat iris. What
// is seen of the iris is shifted by refraction, and light is lost to reflection on its way in, too.
// [Jimenez et al. 2012, Separable Subsurface Scattering and Photorealistic Eyes Rendering]
#ifndef KAAMOS_EYE_HLSLI
#define KAAMOS_EYE_HLSLI

#include "brdf.hlsli"

static const float kCorneaIndex = 1.376;  // of refraction
static const float kIrisPlane = 0.8;      // where the iris lies, along z
static const float kIrisRadius = 0.45;
static const float kPupilRadius = 0.18;
static const float3 kScleraColor = float3(0.8, 0.78, 0.75);
static const float3 kIrisColor = float3(0.12, 0.3, 0.35);

// Returns where a line of sight that meets the ball at `at` arrives on the plane of the iris.
// `direction` goes towards the eye's inside.
float2 IrisPlace(float3 at, float3 direction) {
  if (at.z <= kIrisPlane) return at.xy;
  const float3 inside = refract(direction, at, 1.0 / kCorneaIndex);
  return at.xy + inside.xy * ((kIrisPlane - at.z) / inside.z);
}

float3 EyeColor(float2 place) {
  const float radius = length(place);
  if (radius < kPupilRadius) return float3(0, 0, 0);
  return radius < kIrisRadius ? kIrisColor : kScleraColor;
}

// BRDF times cosine, as EvaluateBrdf: the specular part is that of the unified model, and what it
// does not reflect goes in and comes out again through the coat. Reciprocal.
float3 EvaluateEye(Brdf brdf, BrdfView view, float3 light) {
  const float n_l = dot(view.normal, light);
  if (!(n_l > 0.0)) return float3(0, 0, 0);
  BrdfView glossy = view;
  glossy.diffuse = float3(0, 0, 0);
  const float3 in_and_out = (1.0 - FresnelSchlick(brdf.f0, brdf.f90, view.cosine)) *
                            (1.0 - FresnelSchlick(brdf.f0, brdf.f90, n_l));
  return brdf.diffuse * in_and_out * (n_l * (1.0 / kBrdfPi)) + EvaluateBrdf(brdf, glossy, light);
}

#endif
