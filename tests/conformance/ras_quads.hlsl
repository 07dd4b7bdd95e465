// SPDX-License-Identifier: MIT
// Shaders of the rules of quads, derivatives and discard.
#include "ras.hlsli"

RWByteAddressBuffer words : register(u0);

[shader("pixel")]
float4 OfPosition(float4 position : SV_Position) : SV_Target {
  return float4(ddx(position.x), ddx(position.y), ddy(position.x), ddy(position.y));
}

// Writes derivatives of a function that tells where the quad is.
[shader("pixel")]
float4 OfSquares(float4 position : SV_Position) : SV_Target {
  const float2 squares = position.xy * position.xy;
  return float4(ddx_fine(squares.x), ddy_fine(squares.y), ddx_fine(squares.y), 1.0);
}

[shader("pixel")]
float4 FineOfProduct(float4 position : SV_Position) : SV_Target {
  const float f = position.x * position.y;
  return float4(ddx_fine(f), ddy_fine(f), 0.0, 1.0);
}

struct Coarse {
  float4 coarse : SV_Target0;
  float4 others : SV_Target1;
};

[shader("pixel")]
Coarse CoarseOfProduct(float4 position : SV_Position) {
  const float f = position.x * position.y;
  Coarse result;
  result.coarse = float4(ddx_coarse(f), ddy_coarse(f), ddx(f), ddy(f));
  result.others = float4(fwidth(f), 0.0, 0.0, 1.0);
  return result;
}

[shader("pixel")]
float4 OfValue(float4 position : SV_Position, float4 value : VALUE) : SV_Target {
  return float4(ddx_fine(value.x), ddy_fine(value.x), ddx_fine(value.y), 1.0);
}

// Counts, then asks for a derivative so that helpers run.
[shader("pixel")]
float4 Counted(float4 position : SV_Position, float4 value : VALUE) : SV_Target {
  uint before;
  words.InterlockedAdd(0, 1, before);
  const uint2 place = uint2(position.xy);
  words.Store(64 + (place.x + place.y * 16) * 4, 1);
  return float4(ddx(value.x), 0.0, 0.0, 1.0);
}

[shader("pixel")]
float4 Checkers(float4 position : SV_Position) : SV_Target {
  const uint2 place = uint2(position.xy);
  words.InterlockedAdd(0, 1);
  if (((place.x + place.y) & 1) != 0) discard;
  words.InterlockedAdd(4, 1);
  const float f = position.x * 3.0 + position.y * 5.0;
  return float4(ddx_fine(f), ddy_fine(f), 0.0, 1.0);
}

[shader("pixel")]
float4 ClipsTint() : SV_Target {
  clip(tint);
  return float4(1.0, 1.0, 1.0, 1.0);
}

// The border goes through quads.
[shader("pixel")]
float4 WhereLanesGoApart(float4 position : SV_Position, float4 value : VALUE) : SV_Target {
  float4 result = float4(0.0, 0.0, 0.0, 1.0);
  if (position.x > 5.0) result.xy = float2(ddx_fine(position.x), ddx_fine(value.x));
  return result;
}
