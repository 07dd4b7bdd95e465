// SPDX-License-Identifier: MIT
// The depth of the scene as the sun sees it: a draw for each geometry of each instance, into one
// map after the other.
#include "shadow_map.hlsli"

// Vertices and indices of geometry i are number 2 * i and 2 * i + 1.
ByteAddressBuffer geometry_buffers[] : register(t0, space4);

struct Corner {
  float3 position : POSITION;  // object space
  float2 uv : TEXCOORD;
};

struct ShadowVertex {
  float4 position : SV_Position;
  float2 uv : TEXCOORD;
};

[shader("vertex")]
ShadowVertex ShadowMapVertex(Corner corner) {
  const ShadowMap map = maps[constants.map];
  const float4 position =
      float4(mul(ObjectToWorld(draws[constants.draw]), float4(corner.position, 1.0)), 1.0);
  const float2 at = float2(dot(map.to_map[0], position), dot(map.to_map[1], position)) *
                    (2.0 / float(constants.size));
  ShadowVertex result;
  result.position = float4(at.x - 1.0, 1.0 - at.y, dot(map.to_map[2], position) / map.range, 1.0);
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
HoleVertex ShadowMapHoleVertex(Corner corner, uint vertex : SV_VertexID) {
  const ShadowVertex place = ShadowMapVertex(corner);
  const uint geometry = draws[constants.draw].geometry;
  HoleVertex result;
  result.position = place.position;
  result.uv = HoleUv(geometry_buffers[2 * geometry], geometries[geometry], vertex, place.uv);
  result.alpha = VertexAlpha(geometry_buffers[2 * geometry], geometries[geometry], vertex);
  return result;
}

// Leaves out the holes of the material. Its texture is read at level 0, as rays read it.
[shader("pixel")]
void ShadowMapHoles(HoleVertex vertex) {
  const HitConstants layout = geometries[draws[constants.draw].geometry];
  if (IsOpenAtUv(materials[layout.material_id], vertex.uv, vertex.alpha)) discard;
}
