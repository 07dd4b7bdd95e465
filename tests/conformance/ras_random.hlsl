// SPDX-License-Identifier: MIT
// Shaders of the random triangles and of the closed mesh.
#include "ras.hlsli"

struct Sliced {
  float4 position : SV_Position;
  float value : VALUE;
  noperspective float on_screen : SCREEN;
  uint slice : SV_RenderTargetArrayIndex;
};

// Each triangle of a list to a slice of its own.
[shader("vertex")]
Sliced ToOwnSlice(float4 position : POSITION, float4 value : VALUE, uint vertex : SV_VertexID) {
  Sliced result;
  result.position = position;
  result.value = value.x;
  result.on_screen = value.x;
  result.slice = vertex / 3;
  return result;
}

struct SlicedInput {
  float4 position : SV_Position;
  float value : VALUE;
  noperspective float on_screen : SCREEN;
};

[shader("pixel")]
float4 DepthAndValues(SlicedInput input) : SV_Target {
  return float4(input.position.z, input.value, input.on_screen, 1.0);
}

// A sphere of `number` rings of as many quads. Corners that triangles share are the same numbers.
[shader("vertex")]
float4 Sphere(uint vertex : SV_VertexID) : SV_Position {
  const uint quad = vertex / 6;
  const uint corner = vertex % 6;
  const uint2 cell = uint2(quad % number, quad / number);
  const uint2 place = cell + uint2(corner == 1 || corner >= 4 ? 1 : 0, corner >= 2 && corner != 4 ? 1 : 0);
  const float around = float(place.x % number) / float(number) * 6.2831853;
  const float down = float(place.y) / float(number) * 3.1415927;
  // Poles are one point each.
  const float radius = place.y == 0 || place.y == number ? 0.0 : sin(down) * 0.9;
  const float3 at = float3(radius * cos(around), cos(down) * 0.9, radius * sin(around));
  const float w = 2.0 + at.z + 0.1 * at.x;
  return float4(at.x * 1.7 + at.y * 0.2, at.y * 1.7 - at.z * 0.3, 0.5 * w, w);
}

// Fronts count up, backs down.
[shader("pixel")]
float4 Windings(float4 position : SV_Position, bool front : SV_IsFrontFace) : SV_Target {
  return float4(front ? 1.0 : -1.0, 1.0, 0.0, 0.0);
}
