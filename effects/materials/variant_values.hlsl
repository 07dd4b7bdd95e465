// SPDX-License-Identifier: MIT
// For tests: evaluates the models for view directions of the upper hemisphere and light directions of
// the whole sphere.
#include "variants.hlsli"

// The model's value, as EvaluateBrdf gives it, and z of the light's direction.
RWStructuredBuffer<float4> values : register(u0, space3);

struct ValueConstants {
  uint model;  // a bit of kMaterialVariants; 0: the unified one
  uint rows;   // lights are the middles of rows x columns cells of equal solid angle
  uint columns;
  float cosine_view;
  float3 color;
  float roughness;
  float3 swapped_light;  // not 0: one light alone, and view and light change places
  float f0;
  float f90;
};
ConstantBuffer<ValueConstants> constants : register(b0, space3);

float3 Evaluate(float3 view_direction, float3 light) {
  const Brdf brdf = MakeBrdf(constants.color, 0.0, constants.roughness,
                             float3(1, 1, 1) * constants.f0, constants.f90);
  // Fibres run along +Z where other models have their normal.
  if (constants.model == kMaterialHair) {
    return EvaluateHair(brdf, float3(0, 0, 1), view_direction, light);
  }
  const BrdfView view = MakeBrdfView(brdf, float3(0, 0, 1), view_direction);
  if (constants.model == kMaterialSkin) return EvaluateSkin(brdf, view, light);
  if (constants.model == kMaterialEye) return EvaluateEye(brdf, view, light);
  return EvaluateBrdf(brdf, view, light);
}

[shader("compute")]
[numthreads(64, 1, 1)]
void VariantValues(uint3 id : SV_DispatchThreadID) {
  if (id.x >= constants.rows * constants.columns) return;
  const float cosine = constants.cosine_view;
  const float3 view = float3(sqrt(1.0 - cosine * cosine), 0.0, cosine);
  if (dot(constants.swapped_light, constants.swapped_light) > 0.0) {
    values[id.x] = float4(Evaluate(constants.swapped_light, view), view.z);
    return;
  }
  const float z =
      1.0 - 2.0 * (float(id.x / constants.columns) + 0.5) / float(constants.rows);
  const float turn =
      6.2831853 * (float(id.x % constants.columns) + 0.5) / float(constants.columns);
  const float r = sqrt(1.0 - z * z);
  const float3 light = float3(r * cos(turn), r * sin(turn), z);
  values[id.x] = float4(Evaluate(view, light), z);
}

// Where lines of sight along -Z arrive that meet an eye's ball at some distances from its axis.
[shader("compute")]
[numthreads(64, 1, 1)]
void IrisPlaces(uint3 id : SV_DispatchThreadID) {
  if (id.x >= constants.rows) return;
  const float x = kIrisRadius * float(id.x) / float(constants.rows);
  const float3 at = float3(x, 0.0, sqrt(1.0 - x * x));
  values[id.x] = float4(x, IrisPlace(at, float3(0, 0, -1)), 0.0);
}
