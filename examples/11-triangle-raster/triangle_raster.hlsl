// SPDX-License-Identifier: MIT
// A vertex shader and a pixel shader.

struct Corner {
  float4 position : SV_Position;  // in clip space: x to the right, y up, both -w to w
  float3 color : COLOR;           // interpolated over the triangle
};

[shader("vertex")]
Corner PlaceCorner(float2 position : POSITION, float3 color : COLOR) {
  Corner corner;
  corner.position = float4(position, 0, 1);
  corner.color = color;
  return corner;
}

[shader("pixel")]
float4 FillPixel(Corner corner) : SV_Target {
  return float4(corner.color, 1);
}
