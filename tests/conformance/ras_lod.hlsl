// SPDX-License-Identifier: MIT
// Shaders of the rules of levels of detail and comparison. Textures hold the numbers of their mips.
#include "ras.hlsli"

Texture2D<float> texels : register(t1);
TextureCube<float> cube : register(t2);
Texture2DArray<float> slices : register(t2);
SamplerState trilinear : register(s0);
SamplerComparisonState compares : register(s1);
SamplerState biased : register(s2);
SamplerState limited : register(s3);
SamplerState anisotropic : register(s4);

// The target over 256 pixels, times the tint.
[shader("pixel")]
float4 Levels(float4 position : SV_Position) : SV_Target {
  const float2 uv = position.xy / 256.0 * tint.xy;
  return float4(texels.Sample(trilinear, uv), texels.SampleBias(trilinear, uv, 1.5),
                texels.Sample(biased, uv), texels.Sample(limited, uv));
}

[shader("pixel")]
float4 Calculated(float4 position : SV_Position) : SV_Target {
  const float2 uv = position.xy / 256.0 * tint.xy;
  return float4(texels.CalculateLevelOfDetail(trilinear, uv),
                texels.CalculateLevelOfDetailUnclamped(trilinear, uv), texels.Sample(anisotropic, uv), 1.0);
}

// A face of the cube over the target.
[shader("pixel")]
float4 OfCube(float4 position : SV_Position) : SV_Target {
  const float2 place = (position.xy / 128.0 - 1.0) * tint.x;
  return float4(cube.Sample(trilinear, float3(place.x, -place.y, 1.0)),
                cube.Sample(trilinear, float3(1.0, -place.y, -place.x)), 0.0, 1.0);
}

// The slice changes from pixel to pixel.
[shader("pixel")]
float4 OfArray(float4 position : SV_Position) : SV_Target {
  const float2 uv = position.xy / 256.0 * tint.xy;
  const float slice = float((uint(position.x) + uint(position.y)) % 3);
  return float4(slices.Sample(trilinear, float3(uv, slice)), 0.0, 0.0, 1.0);
}

[shader("pixel")]
float4 Compared() : SV_Target {
  return float4(texels.SampleCmp(compares, tint.xy, tint.z), texels.SampleCmpLevelZero(compares, tint.xy, tint.z),
                0.0, 1.0);
}

[shader("vertex")]
Vertex InVertexShader(uint vertex : SV_VertexID) {
  Vertex result;
  result.position = float4(corner_of_target(vertex), depth, 1.0);
  const float2 uv = float2(0.5, 0.5);
  result.value = float4(texels.SampleLevel(trilinear, uv, 3.0),
                        texels.SampleGrad(trilinear, uv, float2(1.0 / 64.0, 0.0), float2(0.0, 0.0)),
                        texels.SampleCmpLevelZero(compares, uv, -1.0), 1.0);
  result.vertex = vertex;
  result.instance = 0;
  result.element = 0;
  return result;
}
