// SPDX-License-Identifier: MIT
// Shaders of the rules of draw state and indirect draws.
#include "ras.hlsli"

RWByteAddressBuffer words : register(u0);

// Each stage sees a b0 of its own.
[shader("vertex")]
Vertex WithOwnConstants(uint vertex : SV_VertexID) {
  Vertex result;
  result.position = float4(corner_of_target(vertex), depth, 1.0);
  result.value = tint;
  result.vertex = vertex;
  result.instance = 0;
  result.element = 0;
  return result;
}

[shader("pixel")]
float4 BothConstants(Vertex input) : SV_Target {
  return float4(input.value.x, tint.x, 0.0, 1.0);
}

[shader("compute")]
[numthreads(1, 1, 1)]
void StoresNumber() {
  words.Store(0, number);
}

// The place from the index, the value from a buffer.
struct Fetched {
  float4 position : SV_Position;
  nointerpolation float4 value : VALUE;
  nointerpolation uint vertex : VERTEX;
};

[shader("vertex")]
Fetched Fetches(float4 value : VALUE, uint vertex : SV_VertexID) {
  Fetched result;
  result.position = float4(corner_of_target(vertex), depth, 1.0);
  result.value = value;
  result.vertex = vertex;
  return result;
}

// Writes what was fetched, beside the constants; a column for each draw.
[shader("pixel")]
float4 ReadFetched(Fetched input, uint primitive : SV_PrimitiveID) : SV_Target {
  return float4(input.value.x, tint.x, float(input.vertex), 1.0 + float(primitive));
}
