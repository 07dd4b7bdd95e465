// SPDX-License-Identifier: MIT
// Shaders of the rules of viewports and array indices.
#include "ras.hlsli"

struct Placed {
  float4 position : SV_Position;
  uint viewport : SV_ViewportArrayIndex;
  uint slice : SV_RenderTargetArrayIndex;
};

// Indices: of the leading vertex that of the instance; of the others 1 more.
[shader("vertex")]
Placed ToViewport(uint vertex : SV_VertexID, uint instance : SV_InstanceID) {
  Placed result;
  result.position = float4(corner_of_target(vertex), depth, 1.0);
  result.viewport = number + instance + (vertex == 0 ? 0 : 1);
  result.slice = 0;
  return result;
}

[shader("vertex")]
Placed ToSlice(uint vertex : SV_VertexID, uint instance : SV_InstanceID) {
  Placed result;
  result.position = float4(corner_of_target(vertex), depth, 1.0);
  result.viewport = 0;
  result.slice = number + instance + (vertex == 0 ? 0 : 1);
  return result;
}

[shader("pixel")]
uint4 ReadPlace(Placed input) : SV_Target {
  return uint4(input.viewport, input.slice, 1, 0);
}
