// SPDX-License-Identifier: MIT
// This file holds what draws of the scene share with the rays of its camera: clip space, and the
// point of a triangle that the ray through a pixel meets.
#ifndef KAAMOS_GBUFFER_CAMERA_HIT_HLSLI
#define KAAMOS_GBUFFER_CAMERA_HIT_HLSLI

#include "scene_draw.hlsli"
#include "surface.hlsli"

// From relative to the camera to clip space. Depth is reversed, and the far plane infinitely far
// away: z / w = near / view depth. That spreads the depth buffer's floats evenly over the distance.
// Where the camera's rays are parallel, depth has to be straight over a triangle: 1 - view depth /
// far. `clip_scale` is near, or 1 / far. [effects/engine/scene_draws.h: ClipDepth]
float4 ToClip(float3 position, float clip_scale, float2 size) {
  const float view_z = dot(position, frame.camera_forward);
  // The lengths of right and up are half the picture's size at distance 1.
  float2 xy = float2(dot(position, frame.camera_right) * (frame.over_right * frame.over_right),
                     dot(position, frame.camera_up) * (frame.over_up * frame.over_up));
  // The ray of a pixel passes `jitter` beside its centre: the scene moves the other way.
  xy += float2(-2.0, 2.0) * frame.jitter / size * GrowthAt(view_z);
  if (frame.is_orthographic != 0) return float4(xy, 1.0 - view_z * clip_scale, 1.0);
  return float4(xy, clip_scale, view_z);
}

// Weights of a triangle's second and third vertex where a ray from `origin` meets its plane. At the
// border of a triangle the rasterizer takes pixels whose ray just misses it: they get the nearest
// point on it. [Moller & Trumbore 1997]
float2 ClampedBarycentrics(float3 v0, float3 v1, float3 v2, float3 origin, float3 direction) {
  const float3 e1 = v1 - v0;
  const float3 e2 = v2 - v0;
  // The ray starts anew beside the triangle: the rounding of far-away numbers would be multiplied by
  // how thin the triangle is.
  const float way = dot(v0 - origin, direction) / dot(direction, direction);
  const float3 from_v0 = origin + direction * way - v0;
  const float3 p = cross(direction, e2);
  const float3 q = cross(from_v0, e1);
  const float determinant = dot(e1, p);
  // A triangle seen along its plane: its middle is as good as any point.
  if (determinant == 0.0) return float2(1.0 / 3.0, 1.0 / 3.0);
  const float2 weights = float2(dot(from_v0, p), dot(direction, q)) / determinant;
  if (all(weights >= 0.0) && weights.x + weights.y <= 1.0) return weights;
  // The nearest points of its three edges, as seen from v0.
  const float3 hit = e1 * weights.x + e2 * weights.y;
  const float3 e3 = e2 - e1;
  const float2 on_e1 = float2(saturate(dot(hit, e1) / dot(e1, e1)), 0.0);
  const float2 on_e2 = float2(0.0, saturate(dot(hit, e2) / dot(e2, e2)));
  const float along_e3 = saturate(dot(hit - e1, e3) / dot(e3, e3));
  const float2 on_e3 = float2(1.0 - along_e3, along_e3);
  const float to_e1 = length(hit - e1 * on_e1.x);
  const float to_e2 = length(hit - e2 * on_e2.y);
  const float to_e3 = length(hit - e1 * on_e3.x - e2 * on_e3.y);
  if (to_e1 <= to_e2 && to_e1 <= to_e3) return on_e1;
  return to_e2 <= to_e3 ? on_e2 : on_e3;
}

// Returns what a draw shows at a pixel, as a hit of the ray through it. `layout`: of the draw's
// geometry.
TriangleHit CameraHit(ByteAddressBuffer vertices, ByteAddressBuffer indices, HitConstants layout,
                      SceneDraw draw, uint primitive, CameraRay ray) {
  TriangleHit hit;
  hit.layout = layout;
  hit.primitive = primitive;
  hit.object_to_world = ObjectToWorld(draw);
  hit.world_to_object = WorldToObject(draw);
  hit.direction = normalize(ray.direction);
  const uint3 corners = LoadTriangle(indices, hit.layout.index_size_bytes, primitive);
  const uint stride = hit.layout.vertex_stride;
  const float3 origin = mul(hit.world_to_object, float4(ray.origin, 1.0));
  hit.barycentrics = ClampedBarycentrics(LoadVertexFloat3(vertices, stride, 0, corners.x),
                                         LoadVertexFloat3(vertices, stride, 0, corners.y),
                                         LoadVertexFloat3(vertices, stride, 0, corners.z), origin,
                                         mul((float3x3)hit.world_to_object, ray.direction));
  return hit;
}

#endif
