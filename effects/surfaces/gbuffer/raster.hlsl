// SPDX-License-Identifier: MIT
// The visibility buffer: which triangle each pixel shows, found by the rasterizer. A draw for each
// geometry of each instance writes two numbers a pixel, and resolve.hlsl makes the G-buffer of them.
// [Burns & Hunt 2013, The Visibility Buffer]
#include "alpha_test.hlsli"
#include "camera_hit.hlsli"
#include "draws.hlsli"

struct Corner {
  float3 position : POSITION;  // object space
  float2 uv : TEXCOORD;
};

struct RasterVertex {
  float4 position : SV_Position;
  float2 uv : TEXCOORD;
};

[shader("vertex")]
RasterVertex SceneVertex(Corner corner) {
  const SceneDraw draw = draws[constants.draw];
  RasterVertex result;
  result.position = ToClip(mul(ObjectToWorld(draw), float4(corner.position, 1.0)),
                           constants.clip_scale, constants.size);
  result.uv = corner.uv;
  return result;
}

// The same with what IsOpenAtUv asks for.
struct HoleVertex {
  float4 position : SV_Position;
  float2 uv : TEXCOORD;
  float alpha : ALPHA;
};

[shader("vertex")]
HoleVertex SceneVertexWithHoles(Corner corner, uint vertex : SV_VertexID) {
  const RasterVertex place = SceneVertex(corner);
  const uint geometry = draws[constants.draw].geometry;
  HoleVertex result;
  result.position = place.position;
  result.uv = HoleUv(geometry_buffers[2 * geometry], geometries[geometry], vertex, place.uv);
  result.alpha = VertexAlpha(geometry_buffers[2 * geometry], geometries[geometry], vertex);
  return result;
}

[shader("pixel")]
uint2 VisibleTriangle(uint primitive : SV_PrimitiveID) : SV_Target0 {
  return uint2(constants.draw + 1, primitive);
}

// The same where the material has holes. Its texture is read at level 0, as the any-hit shaders of
// rays read it, so that both see the same holes.
[shader("pixel")]
uint2 VisibleTriangleWithHoles(HoleVertex vertex, uint primitive : SV_PrimitiveID) : SV_Target0 {
  const HitConstants layout = geometries[draws[constants.draw].geometry];
  if (IsOpenAtUv(materials[layout.material_id], vertex.uv, vertex.alpha)) discard;
  return uint2(constants.draw + 1, primitive);
}
