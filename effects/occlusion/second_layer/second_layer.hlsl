// SPDX-License-Identifier: MIT
// The second layer of depth by peeling: the scene is drawn once more, and of what lies some way behind
// the first surface of each pixel the nearest stays. [Everitt 2001; Mara et al. 2016]
#include "../../surfaces/gbuffer/camera_hit.hlsli"
#include "alpha_test.hlsli"

// Mirrors DrawConstants of second_layer.cpp.
struct DrawConstants {
  uint draw;         // in `draws`
  float clip_scale;  // of ToClip
  float2 size;       // of the picture, pixels
  float separation;  // metres behind the first surface, at least
};
ConstantBuffer<DrawConstants> constants : register(b0, space3);
StructuredBuffer<SceneDraw> draws : register(t0, space3);
StructuredBuffer<HitConstants> geometries : register(t1, space3);
// Vertices and indices of geometry i are number 2 * i and 2 * i + 1.
ByteAddressBuffer geometry_buffers[] : register(t0, space4);

struct Corner {
  float3 position : POSITION;  // object space
  float2 uv : TEXCOORD;
};

struct LayerVertex {
  float4 position : SV_Position;
  float2 uv : TEXCOORD;
  float view_z : DEPTH;
};

[shader("vertex")]
LayerVertex SecondLayerVertex(Corner corner) {
  const SceneDraw draw = draws[constants.draw];
  const float3 position = mul(ObjectToWorld(draw), float4(corner.position, 1.0));
  LayerVertex result;
  result.position = ToClip(position, constants.clip_scale, constants.size);
  result.uv = corner.uv;
  result.view_z = dot(position, frame.camera_forward);
  return result;
}

// The same with what IsOpenAtUv asks for.
struct HoleVertex {
  float4 position : SV_Position;
  float2 uv : TEXCOORD;
  float view_z : DEPTH;
  float alpha : ALPHA;
};

[shader("vertex")]
HoleVertex SecondLayerHoleVertex(Corner corner, uint vertex : SV_VertexID) {
  const LayerVertex place = SecondLayerVertex(corner);
  const uint geometry = draws[constants.draw].geometry;
  HoleVertex result;
  result.position = place.position;
  result.uv = HoleUv(geometry_buffers[2 * geometry], geometries[geometry], vertex, place.uv);
  result.view_z = place.view_z;
  result.alpha = VertexAlpha(geometry_buffers[2 * geometry], geometries[geometry], vertex);
  return result;
}

// What is nearer than this part of its depth to the first surface is that surface itself, rounded.
static const float kSame = 1e-4;

bool IsFirstLayer(float4 position, float view_z) {
  const float first = g_view_z[uint2(position.xy)];
  return !(view_z > first + max(constants.separation, kSame * first));
}

[shader("pixel")]
float SecondLayerDepth(LayerVertex vertex) : SV_Target0 {
  if (IsFirstLayer(vertex.position, vertex.view_z)) discard;
  return vertex.view_z;
}

[shader("pixel")]
float SecondLayerDepthWithHoles(HoleVertex vertex) : SV_Target0 {
  if (IsFirstLayer(vertex.position, vertex.view_z)) discard;
  const HitConstants layout = geometries[draws[constants.draw].geometry];
  if (IsOpenAtUv(materials[layout.material_id], vertex.uv, vertex.alpha)) discard;
  return vertex.view_z;
}
