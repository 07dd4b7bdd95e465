// SPDX-License-Identifier: MIT
// Shaders of the rules of lines and points, and of blending two sources.
#include "ras.hlsli"

[shader("pixel")]
float4 Weights(float3 weights : SV_Barycentrics) : SV_Target0 {
  return float4(weights, 1.0);
}

// All bits, if a number is asked for.
[shader("pixel")]
uint4 FrontAsNumber(uint front : SV_IsFrontFace) : SV_Target0 {
  return uint4(front, ~front, 0, 1);
}

struct TwoSources {
  float4 first : SV_Target0;
  float4 second : SV_Target1;
};

[shader("pixel")]
TwoSources Sources() {
  TwoSources result;
  result.first = tint;
  result.second = float4(0.25, 0.5, 0.75, 0.125) * number;
  return result;
}

struct Varying {
  float4 position : SV_Position;
  float2 curved : CURVED;
  noperspective float straight : STRAIGHT;
};

[shader("vertex")]
Varying Moving(float4 position : POSITION, float4 value : VALUE) {
  Varying result;
  result.position = position;
  result.curved = value.xy;
  result.straight = value.z;
  return result;
}

// Inputs 3/16 pixel to the right of the middle and 5/16 above it, and in the middle.
[shader("pixel")]
float4 Snapped(Varying input) : SV_Target0 {
  return float4(EvaluateAttributeSnapped(input.curved.y, int2(3, -5)), input.curved.y,
                EvaluateAttributeSnapped(input.straight, int2(3, -5)),
                EvaluateAttributeAtSample(input.curved, 0).y);
}

// Where the targets' samples are, and the number of samples.
[shader("pixel")]
float4 SamplePlaces() : SV_Target0 {
  return float4(GetRenderTargetSamplePosition(number), GetRenderTargetSampleCount(), 1.0);
}
