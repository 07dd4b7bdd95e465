// SPDX-License-Identifier: MIT
// Skin: light that enters beside a point leaves at it, red farther away than blue, so that it is lit
// beyond the line where the sun sets. Lambert's cosine is wrapped around the surface for that.
// [Green 2004, Real-Time Approximations to Subsurface Scattering] The specular part is that of the
// unified model.
#ifndef KAAMOS_SKIN_HLSLI
#define KAAMOS_SKIN_HLSLI

#include "brdf.hlsli"

// The cosine of the angle beyond the horizon at which light still arrives.
static const float3 kSkinWrap = float3(0.35, 0.15, 0.08);

// In place of max(cosine, 0). Its integral over all directions is pi, too: no energy is made.
float3 WrappedCosine(float cosine) {
  const float3 whole = 1.0 + kSkinWrap;
  return max(cosine + kSkinWrap, 0.0) / (whole * whole);
}

// BRDF times cosine, as EvaluateBrdf. It is not reciprocal: the cosine of the view is not wrapped.
float3 EvaluateSkin(Brdf brdf, BrdfView view, float3 light) {
  BrdfView glossy = view;
  glossy.diffuse = float3(0, 0, 0);
  return view.diffuse * (1.0 / kBrdfPi) * WrappedCosine(dot(view.normal, light)) +
         EvaluateBrdf(brdf, glossy, light);
}

#endif
