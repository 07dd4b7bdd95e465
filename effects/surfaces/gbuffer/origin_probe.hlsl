// SPDX-License-Identifier: MIT
// For tests: a ray in one direction from each pixel's surface, once from the origin that the G-buffer
// has, once from one that is reconstructed from the rasterizer's depth.
#include "depth_origin.hlsli"

struct ProbeConstants {
  float3 direction;  // unit
  float near_plane;  // of `raster_depth`, which is near_plane / view depth
};

ConstantBuffer<ProbeConstants> constants : register(b0, space3);
Texture2D<float> raster_depth : register(t0, space3);
// 1: the ray is free, from the G-buffer's origin and from the reconstructed one; 1: a surface; cosine
// between its normal and the ray.
RWTexture2D<float4> probed : register(u0, space3);

float IsFree(float3 origin) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0.0;
  ray.Direction = constants.direction;
  ray.TMax = kLongestRay;
  RayQuery<RAY_FLAG_FORCE_OPAQUE | RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH> query;
  query.TraceRayInline(scene, RAY_FLAG_NONE, 0xFF, ray);
  query.Proceed();
  return query.CommittedStatus() == COMMITTED_NOTHING ? 1.0 : 0.0;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void ProbeOrigins(uint3 id : SV_DispatchThreadID) {
  const uint2 pixel = id.xy;
  uint2 size;
  probed.GetDimensions(size.x, size.y);
  if (any(pixel >= size)) return;
  probed[pixel] = float4(0, 0, 0, 0);
  if (g_ids[pixel].x == 0) return;
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  const float facing_light = dot(normal, constants.direction);
  const float side = facing_light >= 0.0 ? 1.0 : -1.0;
  const float4 position = g_position[pixel];
  const float exact = IsFree(position.xyz + normal * (side * position.w));

  const float view_z = constants.near_plane / raster_depth[pixel];
  const float3 rebuilt =
      PositionFromDepth(float2(pixel) + 0.5 + frame.jitter, float2(size), view_z);
  const float offset =
      DepthOriginOffset(view_z, abs(dot(normal, SeenAlong(rebuilt))), float(size.y));
  probed[pixel] =
      float4(exact, IsFree(rebuilt + normal * (side * offset)), 1.0, facing_light);
}
