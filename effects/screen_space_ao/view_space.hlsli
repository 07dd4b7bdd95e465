// SPDX-License-Identifier: MIT
// What every screen-space technique of this folder starts from: points of the depth picture in view
// space. There x goes right, y up and z into the picture, in metres, and the camera is the origin.
#ifndef KAAMOS_VIEW_SPACE_HLSLI
#define KAAMOS_VIEW_SPACE_HLSLI

#include "frame.hlsli"

static const float kTwoPi = 6.28318530718;

// The effect's picture, and what stands between its passes.
RWTexture2D<float4> result : register(u0, space3);  // visibility: 1 open, 0 occluded
RWTexture2D<float> raw : register(u1, space3);      // before the filter
RWTexture2D<float> filtered : register(u2, space3);

int2 PictureSize() {
  uint width, height;
  g_view_z.GetDimensions(width, height);
  return int2(width, height);
}

bool IsInside(int2 pixel, int2 size) { return all(pixel >= int2(0, 0)) && all(pixel < size); }

// The sky has no depth, and a broken depth shows nothing either. [effects-spec E.2]
bool IsSurface(float view_z) { return view_z > 0.0 && isfinite(view_z); }

// As the pass has it, and never so long that points at its end have no place in the picture.
float Radius() { return min(pass_constants.radius, 1e6); }

// x/z and y/z of a place in the picture, in pixels from the upper left corner.
float2 SlopeAt(float2 place, int2 size) {
  const float2 ndc = (place + frame.jitter) / float2(size) * 2.0 - 1.0;
  return float2(ndc.x / frame.over_right, -ndc.y / frame.over_up);
}

// Pixels for one unit of x/z and y/z.
float2 PixelsPerSlope(int2 size) {
  return 0.5 * float2(size) * float2(frame.over_right, -frame.over_up);
}

float3 ViewPosition(int2 pixel, float view_z, int2 size) {
  return float3(SlopeAt(float2(pixel) + 0.5, size) * view_z, view_z);
}

// Where a point before the camera stands in the picture, in pixels.
float2 PlaceOf(float3 position, int2 size) {
  return 0.5 * float2(size) - frame.jitter + position.xy / position.z * PixelsPerSlope(size);
}

// A stored normal in view space. A broken one is replaced by the direction to the camera.
float3 ViewNormal(float2 encoded, float3 to_camera) {
  const float3 n = OctahedralDecode(encoded);
  const float3 normal = float3(dot(n, frame.camera_right) * frame.over_right,
                               dot(n, frame.camera_up) * frame.over_up,
                               dot(n, frame.camera_forward));
  return dot(normal, normal) > 0.5 ? normal : to_camera;
}

// Two directions square to the view ray and to each other.
struct ViewBasis {
  float3 right;
  float3 up;
};

ViewBasis MakeViewBasis(float3 to_camera) {
  ViewBasis basis;
  basis.right = normalize(float3(1, 0, 0) - to_camera.x * to_camera);
  basis.up = cross(basis.right, to_camera);
  return basis;
}

// How many pixels a point moves in the picture if it goes one metre along `direction`.
float2 PixelsPerMetre(float3 position, float3 direction, int2 size) {
  const float2 slope = (direction.xy * position.z - position.xy * direction.z) /
                       (position.z * position.z);
  return slope * PixelsPerSlope(size);
}

// A number in 0..1 for each pixel of a tile of 4 x 4, and another one that does not go with it: a
// filter of that size sees them all.
float2 TileNoise(int2 pixel) {
  const uint x = uint(pixel.x) & 3u;
  const uint y = uint(pixel.y) & 3u;
  const uint bits = x ^ y;
  const uint rank = ((bits & 1u) << 3u) | ((y & 1u) << 2u) | (bits & 2u) | ((y & 2u) >> 1u);
  const uint other = (rank * 7u + 3u) & 15u;
  return (float2(float(rank), float(other)) + 0.5) / 16.0;
}

#endif
