// SPDX-License-Identifier: MIT
// Shaders of the rules of depth.
#include "ras.hlsli"

Texture2D<float4> depth_texels : register(t1);
Texture2D<uint4> stencil_texels : register(t2);

[shader("pixel")]
float4 ReadDepth(float4 position : SV_Position) : SV_Target {
  return depth_texels.Load(int3(position.xy, 0));
}

[shader("pixel")]
float4 ReadDepthAndStencil(float4 position : SV_Position) : SV_Target {
  const int3 place = int3(position.xy, 0);
  return float4(depth_texels.Load(place).x, float(stencil_texels.Load(place).y), 0.0, 1.0);
}

// A mesh of hills: quads of a grid of `number` by `number`, seen by a camera. The corners are
// computed by arithmetic that a compiler might contract.
float4 hill(uint vertex) {
  const uint quad = vertex / 6;
  const uint corner = vertex % 6;
  const uint2 cell = uint2(quad % number, quad / number);
  const uint2 place = cell + uint2(corner == 1 || corner >= 4 ? 1 : 0, corner >= 2 && corner != 4 ? 1 : 0);
  const float2 at = float2(place) / float(number) * 2.0 - 1.0;
  const float height = 0.1 * sin(at.x * 19.0) * cos(at.y * 23.0) + 0.03 * sin(at.x * at.y * 90.0);
  const float3 world = float3(at.x * 3.0, height, at.y * 3.0 + 4.0);
  const float4x4 view = float4x4(0.9, 0.1, 0.05, 0.1,
                                 -0.02, 1.1, 0.3, -1.3,
                                 0.01, -0.2, 0.9, 0.5,
                                 0.0, 0.0, 0.0, 1.0);
  const float4 seen = mul(view, float4(world, 1.0));
  return float4(seen.x * 1.3, seen.y * 1.7, seen.z * 1.01 - 0.1, seen.z);
}

[shader("vertex")]
float4 HillsOnly(uint vertex : SV_VertexID) : SV_Position {
  return hill(vertex);
}

[shader("vertex")]
Vertex Hills(uint vertex : SV_VertexID, uint instance : SV_InstanceID) {
  Vertex result;
  result.position = hill(vertex);
  result.value = float4(result.position.xyz * 0.5, 1.0);
  result.vertex = vertex;
  result.instance = instance;
  result.element = vertex / 6;
  return result;
}
