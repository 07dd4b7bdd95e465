// SPDX-License-Identifier: MIT
// Shaders of the rules between vertex and pixel shader.
#include "ras.hlsli"

struct Linked {
  float4 position : SV_Position;
  float2 uv : UV;
  float3 color : Color;
  uint id : ID;
  int number : NUMBER;
};

[shader("vertex")]
Linked Outputs(uint vertex : SV_VertexID) {
  Linked result;
  result.position = float4(corner_of_target(vertex), depth, 1.0);
  result.uv = float2(1.0, 2.0);
  result.color = float3(4.0, 8.0, 16.0);
  result.id = 32 + vertex;
  result.number = -64 - int(vertex);
  return result;
}

[shader("pixel")]
float4 InOrder(float4 position : SV_Position, float2 uv : UV, float2 color : COLOR) : SV_Target {
  return float4(uv, color);
}

[shader("pixel")]
float4 OtherOrder(float3 color : COLOR0, float2 uv : UV) : SV_Target {
  return float4(uv, color.xy);
}

[shader("pixel")]
float4 WantsMore(float4 uv : UV) : SV_Target {
  return uv;
}

[shader("pixel")]
float4 WantsInt(int id : ID) : SV_Target {
  return float4(id, 0, 0, 0);
}

[shader("pixel")]
float4 WantsOther(float4 uv : NORMAL) : SV_Target {
  return uv;
}

// Integers without a modifier.
[shader("pixel")]
uint4 Integers(uint id : ID, int number : NUMBER) : SV_Target {
  return uint4(id, asuint(number), 0, 1);
}

struct NoPosition {
  float4 position : POSITION;
};

[shader("vertex")]
NoPosition Nowhere(uint vertex : SV_VertexID) {
  NoPosition result;
  result.position = float4(corner_of_target(vertex), depth, 1.0);
  return result;
}

struct EightDistances {
  float4 position : SV_Position;
  float4 clip : SV_ClipDistance0;
  float4 cull : SV_CullDistance0;
};

// The last clip distance leaves the right half.
[shader("vertex")]
EightDistances Eight(uint vertex : SV_VertexID) {
  EightDistances result;
  result.position = float4(corner_of_target(vertex), depth, 1.0);
  result.clip = float4(1.0, 1.0, 1.0, result.position.x);
  result.cull = float4(1.0, 1.0, 1.0, 1.0);
  return result;
}

[shader("pixel")]
float4 ReadsClip(float4 position : SV_Position, float4 clip : SV_ClipDistance0) : SV_Target {
  return clip;
}
