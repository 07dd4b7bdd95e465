// SPDX-License-Identifier: MIT
// The debugger test stops in here, in a function that a pixel shader calls, at one pixel.

struct Vertex {
  float4 position : SV_Position;
  float2 uv : TEXCOORD0;
};

[shader("vertex")]
Vertex ProbeVertex(uint vertex : SV_VertexID) {
  Vertex result;
  result.uv = float2(vertex == 1 ? 2.0 : 0.0, vertex == 2 ? 2.0 : 0.0);
  result.position = float4(result.uv.x * 2.0 - 1.0, 1.0 - result.uv.y * 2.0, 0.5, 1.0);
  return result;
}

float Shade(float2 uv, uint x, uint y) {
  const float slope = ddx(uv.x) * 4.0;  // of a target of 4 x 4 pixels: 1
  const float shade = slope + float(x + 10 * y);
  return shade * 0.5;  // BREAK HERE
}

[shader("pixel")]
float4 ProbePixel(Vertex input) : SV_Target0 {
  const uint2 pixel = uint2(input.position.xy);
  const float shade = Shade(input.uv, pixel.x, pixel.y);  // CALLED FROM HERE
  return float4(shade, input.uv, 1.0);
}
