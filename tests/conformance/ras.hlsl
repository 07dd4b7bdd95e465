// SPDX-License-Identifier: MIT
// Shaders that most of the RAS rules need.
#include "ras.hlsli"

[shader("vertex")]
Vertex Pass(float4 position : POSITION, float4 value : VALUE, uint vertex : SV_VertexID,
            uint instance : SV_InstanceID) {
  Vertex result;
  result.position = position;
  result.position.xy += offset * instance;
  result.value = value;
  result.vertex = vertex;
  result.instance = instance;
  result.element = uint(value.x);
  return result;
}

// A triangle that covers the target.
[shader("vertex")]
Vertex Whole(uint vertex : SV_VertexID, uint instance : SV_InstanceID) {
  Vertex result;
  result.position = float4(corner_of_target(vertex), depth, 1.0);
  result.value = tint;
  result.vertex = vertex;
  result.instance = instance;
  result.element = number;
  return result;
}

[shader("pixel")]
float4 Value(Vertex input) : SV_Target0 {
  return input.value;
}

[shader("pixel")]
float4 Tint() : SV_Target0 {
  return tint;
}

[shader("pixel")]
uint4 Number() : SV_Target0 {
  return uint4(number, number, number, number);
}

[shader("pixel")]
uint4 Facts(Vertex input, uint primitive : SV_PrimitiveID, bool front : SV_IsFrontFace) : SV_Target0 {
  return uint4(input.vertex, primitive, 0x20000u | (front ? 0x10000u : 0u) | (input.instance & 0xFFFFu),
               input.element);
}

[shader("pixel")]
float4 Place(float4 position : SV_Position) : SV_Target0 {
  return position;
}

struct ColorAndDepth {
  float4 color : SV_Target0;
  float depth : SV_Depth;
};

// Depth is the tint's red.
[shader("pixel")]
ColorAndDepth OwnDepth() {
  ColorAndDepth result;
  result.color = tint;
  result.depth = tint.x;
  return result;
}

// The same, within what the triangle allows.
[shader("pixel")]
float4 NoLessDepth(out float depth : SV_DepthGreaterEqual) : SV_Target0 {
  depth = tint.x;
  return tint;
}

[shader("pixel")]
float4 NoMoreDepth(out float depth : SV_DepthLessEqual) : SV_Target0 {
  depth = tint.x;
  return tint;
}

struct TwoColors {
  float4 first : SV_Target0;
  float4 second : SV_Target1;
};

[shader("pixel")]
TwoColors Both() {
  TwoColors result;
  result.first = tint;
  result.second = tint;
  return result;
}
