// SPDX-License-Identifier: MIT
// Shaders of the rules of the input assembler.
#include "ras.hlsli"

// An element of an instance's own.
[shader("vertex")]
Vertex Streams(float4 position : POSITION, uint element : ELEMENT, uint vertex : SV_VertexID,
               uint instance : SV_InstanceID) {
  Vertex result;
  result.position = position;
  result.position.xy += offset * instance;
  result.value = float4(0, 0, 0, 0);
  result.vertex = vertex;
  result.instance = instance;
  result.element = element;
  return result;
}

// The bits that an element became. The vertex's place does not depend on it.
struct Bits {
  float4 position : SV_Position;
  nointerpolation uint4 bits : BITS;
};

[shader("vertex")]
Bits Floats(float4 value : VALUE, uint vertex : SV_VertexID) {
  Bits result;
  result.position = float4(corner_of_target(vertex), 0.5, 1.0);
  result.bits = asuint(value);
  return result;
}

[shader("vertex")]
Bits Uints(uint4 value : VALUE, uint vertex : SV_VertexID) {
  Bits result;
  result.position = float4(corner_of_target(vertex), 0.5, 1.0);
  result.bits = value;
  return result;
}

[shader("vertex")]
Bits Ints(int4 value : VALUE, uint vertex : SV_VertexID) {
  Bits result;
  result.position = float4(corner_of_target(vertex), 0.5, 1.0);
  result.bits = asuint(value);
  return result;
}

[shader("vertex")]
Bits Colors(float2 position : POSITION, float2 color0 : COLOR0, float2 color1 : COLOR1,
            float2 color2 : COLOR2, float2 color3 : COLOR3) {
  Bits result;
  result.position = float4(position, 0.5, 1.0);
  // Small whole numbers, a byte each.
  const uint2 packed = uint2(color0) | uint2(color1) << 8 | uint2(color2) << 16 | uint2(color3) << 24;
  result.bits = uint4(packed, 0, 0);
  return result;
}

[shader("pixel")]
uint4 WriteBits(Bits input) : SV_Target0 {
  return input.bits;
}

RWByteAddressBuffer words : register(u0);

[shader("vertex")]
float4 Counted(uint vertex : SV_VertexID) : SV_Position {
  words.InterlockedAdd(0, 1);
  words.InterlockedAdd(4 + vertex * 4, 1);
  return float4(corner_of_target(vertex), 0.5, 1.0);
}
