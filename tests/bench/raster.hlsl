// SPDX-License-Identifier: MIT
// The draws of raster/...; hand_vulkan_raster.cpp has the same in GLSL.

cbuffer Constants : register(b0) {
  float4 clip[4];    // rows: from the world to this frame's clip space
  float4 before[3];  // to that of the frame before: x, y, w
  uint first_triangle;
};

float4 to_clip(float3 position) {
  const float4 p = float4(position, 1.0);
  return float4(dot(clip[0], p), dot(clip[1], p), dot(clip[2], p), dot(clip[3], p));
}

[shader("vertex")]
float4 DepthVertex(float3 position : POSITION) : SV_Position {
  return to_clip(position);
}

struct Surface {
  float4 position : SV_Position;
  float3 world : WORLD;
  float3 now : NOW;
  float3 before : BEFORE;
};

[shader("vertex")]
Surface GBufferVertex(float3 position : POSITION) {
  const float4 p = float4(position, 1.0);
  Surface result;
  result.position = to_clip(position);
  result.world = position;
  result.now = result.position.xyw;
  result.before = float3(dot(before[0], p), dot(before[1], p), dot(before[2], p));
  return result;
}

struct GBuffer {
  float4 albedo : SV_Target0;
  float4 normal : SV_Target1;
  float4 material : SV_Target2;
  float2 motion : SV_Target3;
  uint id : SV_Target4;
};

[shader("pixel")]
GBuffer GBufferPixel(Surface surface, uint primitive : SV_PrimitiveID) {
  const float3 normal = normalize(cross(ddx_fine(surface.world), ddy_fine(surface.world)));
  GBuffer result;
  result.albedo = float4(saturate(0.05 * surface.world + 0.5), 1.0);
  result.normal = float4(normal, surface.now.z);
  result.material = float4(0.3 + 0.4 * abs(normal.y), 0.0, 1.0, 0.5);
  result.motion = surface.now.xy / surface.now.z - surface.before.xy / surface.before.z;
  result.id = first_triangle + primitive;
  return result;
}

[shader("pixel")]
uint IdPixel(uint primitive : SV_PrimitiveID) : SV_Target0 {
  return first_triangle + primitive;
}
