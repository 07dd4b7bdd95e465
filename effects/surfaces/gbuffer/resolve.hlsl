// SPDX-License-Identifier: MIT
// The G-buffer from the visibility buffer. The rasterizer moved each vertex to its grid of 1/256
// pixel, so that its depth is that of a slightly shifted triangle. Here the ray through the pixel is
// intersected with the triangle itself, which gives the point that a primary ray would have hit and
// a start for other rays that is as exact. [Waechter, van Antwerpen & Klehm 2023]
#include "camera_hit.hlsli"
#include "draws.hlsli"
#include "store.hlsli"

void ResolvePixel(ByteAddressBuffer vertices, ByteAddressBuffer indices, uint2 pixel,
                  SceneDraw draw, uint primitive, CameraRay ray) {
  const TriangleHit hit =
      CameraHit(vertices, indices, geometries[draw.geometry], draw, primitive, ray);
  const float3 position = LoadHitPoint(vertices, indices, hit).spawn.position;
  const float view_z = dot(position, frame.camera_forward);
  StoreSurface(pixel, vertices, indices, hit, draw.instance,
               uint2((draw.instance & 0xFFFFFFu) + 1, primitive), view_z,
               ConeWidthAfter(view_z * length(ray.direction)));
}

[shader("compute")]
[numthreads(8, 8, 1)]
void ResolveVisibility(uint3 id : SV_DispatchThreadID) {
  const uint2 pixel = id.xy;
  const uint2 size = uint2(constants.size);
  if (any(pixel >= size)) return;
  const uint2 seen = visibility[pixel];
  if (seen.x == 0) {
    StoreNothing(pixel);
    return;
  }
  const SceneDraw draw = draws[seen.x - 1];
  const uint vertices_at = 2 * draw.geometry;
  ResolvePixel(geometry_buffers[NonUniformResourceIndex(vertices_at)],
               geometry_buffers[NonUniformResourceIndex(vertices_at + 1)], pixel, draw, seen.y,
               PixelRay(pixel, size));
}
