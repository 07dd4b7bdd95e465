// SPDX-License-Identifier: MIT
// Shaders of the rules of clipping and of depth that is out of range.
#include "ras.hlsli"

struct Flat {
  float4 position : SV_Position;
  nointerpolation uint bits : BITS;
  float linear_value : LINEAR;
  noperspective float screen_value : SCREEN;
};

// value: bits, a linear value, one that is linear on the screen.
[shader("vertex")]
Flat Three(float4 position : POSITION, float4 value : VALUE) {
  Flat result;
  result.position = position;
  result.bits = asuint(value.x);
  result.linear_value = value.y;
  result.screen_value = value.z;
  return result;
}

[shader("pixel")]
uint4 ReadThree(Flat input) : SV_Target {
  return uint4(input.bits, asuint(input.linear_value), asuint(input.screen_value), 1);
}

struct Clipped {
  float4 position : SV_Position;
  float2 clip : SV_ClipDistance0;
  float4 value : VALUE;
};

[shader("vertex")]
Clipped ClipsAtXY(float4 position : POSITION, float4 value : VALUE) {
  Clipped result;
  result.position = position;
  result.clip = value.xy;
  result.value = value;
  return result;
}

struct Culled {
  float4 position : SV_Position;
  float2 cull : SV_CullDistance0;
};

[shader("vertex")]
Culled CullsAtXY(float4 position : POSITION, float4 value : VALUE) {
  Culled result;
  result.position = position;
  result.cull = value.xy;
  return result;
}
