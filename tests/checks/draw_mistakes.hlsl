// SPDX-License-Identifier: MIT
// Shaders of draws that make one mistake each.

cbuffer Constants : register(b0) {
  float4 tint;
};

[shader("vertex")]
float4 FromBuffer(float4 position : POSITION) : SV_Position {
  return position;
}

[shader("vertex")]
float4 PerInstance(float4 position : POSITION, float4 shift : SHIFT) : SV_Position {
  return position + shift;
}

// A clockwise triangle that covers the target, at the depth of tint.w.
[shader("vertex")]
float4 WholeTarget(uint vertex : SV_VertexID) : SV_Position {
  return float4(vertex == 1 ? 3.0 : -1.0, vertex == 2 ? -3.0 : 1.0, tint.w, 1.0);
}

[shader("pixel")]
float4 Constant() : SV_Target0 {
  return tint;
}

[shader("pixel")]
float4 Divided() : SV_Target0 {
  return float4(tint.x / tint.y, 0.0, 0.0, 1.0);
}

[shader("pixel")]
float4 DividedDepth(out float depth : SV_Depth) : SV_Target0 {
  depth = tint.x / tint.y;
  return float4(0.0, 0.0, 0.0, 1.0);
}

[shader("pixel")]
float4 Discards() : SV_Target0 {
  if (tint.x < 2.0) discard;
  return tint;
}

[earlydepthstencil]
[shader("pixel")]
float4 EarlyDiscards() : SV_Target0 {
  if (tint.x < 0.5) discard;
  return tint;
}

[earlydepthstencil]
[shader("pixel")]
float4 EarlyDepth(out float depth : SV_Depth) : SV_Target0 {
  depth = 0.5;
  return tint;
}

[shader("pixel")]
float4 Diverges(float4 position : SV_Position) : SV_Target0 {
  float slope = 0.0;
  float value = position.x;
  if (position.x > tint.x) {
    value *= 2.0;  // so that the derivative cannot be taken before the branch
    slope = ddx(value);
  }
  return float4(slope, 0.0, 0.0, 1.0);
}

Texture2D<float4> image : register(t0);

[shader("pixel")]
float4 Fetched(float4 position : SV_Position) : SV_Target0 {
  return image.Load(int3(position.xy, 0));
}

RWByteAddressBuffer stored : register(u0);

[shader("pixel")]
float4 Stores(float4 position : SV_Position) : SV_Target0 {
  stored.Store(4 * (uint(position.x) + 16 * uint(position.y)), asuint(tint.x));
  return tint;
}

[shader("pixel")]
float4 Counts() : SV_Target0 {
  stored.InterlockedAdd(0, 1);
  return tint;
}
