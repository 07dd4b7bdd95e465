// SPDX-License-Identifier: MIT
// Ray origins for passes that know a surface by its depth and normal alone, as screen-space effects
// do. Where the triangle is known, g_position is better: it is exact, and its offset much smaller.
#ifndef KAAMOS_DEPTH_ORIGIN_HLSLI
#define KAAMOS_DEPTH_ORIGIN_HLSLI

#include "frame.hlsli"

// The point at a view depth on the ray through a pixel, relative to the camera. `place` counts
// pixels from the picture's upper left corner: a pixel's centre is at .5, and jitter is added.
float3 PositionFromDepth(float2 place, float2 size, float view_z) {
  const float2 ndc = place / size * 2.0 - 1.0;
  const CameraRay ray = RayThrough(ndc);
  return ray.origin + view_z * ray.direction;
}

// Returns how far along the geometric normal a ray must start there, in metres. Depth belongs to a
// triangle whose vertices the rasterizer moved by up to sqrt(2) / 512 pixel, and has a float's 24
// digits; `facing` is the cosine between normal and view. [D3D11.3 3.4.1]
float DepthOriginOffset(float view_z, float facing, float picture_height) {
  const float pixel = 2.0 * GrowthAt(view_z) / (frame.over_up * picture_height);  // its height at that depth
  const float snapped = 1.41421356 / 512.0 * pixel;
  const float rounded = 5.9604645e-8 * view_z;
  return max(1e-4, max(4.0 * rounded, 2.0 * snapped)) / max(facing, 0.05);
}

#endif
