// SPDX-License-Identifier: MIT
// A Cook-Torrance BRDF: GGX, height-correlated Smith, Schlick's Fresnel.
#pragma once

static const float kPi = 3.14159265;

// Reflectance at an angle, from that at normal incidence. [Schlick 1994]
float3 fresnel(float3 f0, float cos_angle) {
  return f0 + (1 - f0) * pow(saturate(1 - cos_angle), 5);
}

// The share of microfacets that face the half vector, per steradian.
float ggx(float n_dot_h, float alpha) {
  const float a2 = alpha * alpha;
  const float d = n_dot_h * n_dot_h * (a2 - 1) + 1;
  return a2 / (kPi * d * d);
}

// Masking and shadowing over 4 (n.l)(n.v).
float smith_visibility(float n_dot_l, float n_dot_v, float alpha) {
  const float a2 = alpha * alpha;
  const float l = n_dot_v * sqrt(n_dot_l * n_dot_l * (1 - a2) + a2);
  const float v = n_dot_l * sqrt(n_dot_v * n_dot_v * (1 - a2) + a2);
  return 0.5 / max(l + v, 1e-6);
}

float3 specular(float3 n, float3 v, float3 l, float3 f0, float alpha) {
  const float3 h = normalize(v + l);
  const float n_dot_l = saturate(dot(n, l));
  const float n_dot_v = saturate(dot(n, v));
  if (n_dot_l <= 0 || n_dot_v <= 0) return 0;
  return ggx(saturate(dot(n, h)), alpha) * smith_visibility(n_dot_l, n_dot_v, alpha) *
         fresnel(f0, saturate(dot(v, h)));
}
