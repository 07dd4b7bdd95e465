// SPDX-License-Identifier: MIT
// Points of the depth picture in view space, which techniques of the screen start from. There x goes
// right, y up and z into the picture, in metres, and the camera is the origin.
#ifndef KAAMOS_VIEW_SPACE_HLSLI
#define KAAMOS_VIEW_SPACE_HLSLI

#include "frame.hlsli"

int2 PictureSize() {
  uint width, height;
  g_view_z.GetDimensions(width, height);
  return int2(width, height);
}

bool IsInside(int2 pixel, int2 size) { return all(pixel >= int2(0, 0)) && all(pixel < size); }

// The sky has no depth, and a broken depth shows nothing either.
bool IsSurface(float view_z) { return view_z > 0.0 && isfinite(view_z); }

// x/z and y/z of a place in the picture, in pixels from the upper left corner; x and y themselves
// where the camera's rays are parallel.
float2 SlopeAt(float2 place, int2 size) {
  const float2 ndc = (place + frame.jitter) / float2(size) * 2.0 - 1.0;
  return float2(ndc.x / frame.over_right, -ndc.y / frame.over_up);
}

// Pixels for one unit of x/z and y/z.
float2 PixelsPerSlope(int2 size) {
  return 0.5 * float2(size) * float2(frame.over_right, -frame.over_up);
}

float3 ViewPosition(int2 pixel, float view_z, int2 size) {
  return float3(SlopeAt(float2(pixel) + 0.5, size) * GrowthAt(view_z), view_z);
}

// Returns where a point before the camera stands in the picture, in pixels.
float2 PlaceOf(float3 position, int2 size) {
  return 0.5 * float2(size) - frame.jitter + position.xy / GrowthAt(position.z) * PixelsPerSlope(size);
}

// The unit vector from a point to the camera, in view space.
float3 ToCamera(float3 position) {
  return frame.is_orthographic != 0 ? float3(0, 0, -1) : -normalize(position);
}

// A direction of the world in view space.
float3 ViewDirection(float3 direction) {
  return float3(dot(direction, frame.camera_right) * frame.over_right,
                dot(direction, frame.camera_up) * frame.over_up,
                dot(direction, frame.camera_forward));
}

// A stored normal in view space. A broken one is replaced by the direction to the camera.
float3 ViewNormal(float2 encoded, float3 to_camera) {
  const float3 normal = ViewDirection(OctahedralDecode(encoded));
  return dot(normal, normal) > 0.5 ? normal : to_camera;
}

// Returns how many pixels a point moves in the picture if it goes one metre along `direction`.
float2 PixelsPerMetre(float3 position, float3 direction, int2 size) {
  if (frame.is_orthographic != 0) return direction.xy * PixelsPerSlope(size);
  const float2 slope = (direction.xy * position.z - position.xy * direction.z) /
                       (position.z * position.z);
  return slope * PixelsPerSlope(size);
}

#endif
