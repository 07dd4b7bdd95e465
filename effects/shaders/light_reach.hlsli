// SPDX-License-Identifier: MIT
// Finds what a local light reaches, for culling.
#ifndef KAAMOS_LIGHT_REACH_HLSLI
#define KAAMOS_LIGHT_REACH_HLSLI

#include "frame.hlsli"

// A map's cone ends at this cosine; the light's own cone may be wider. [light_constants.cpp]
static const float kWidestMap = 0.05;

struct Sphere {
  float3 center;
  float radius;
};

// The smallest sphere around all that a light reaches. A spot's cone ends in a cap. If the cone is
// narrow, the sphere passes through its tip and the rim of the cap; if it is wide, the rim is the
// sphere's equator.
Sphere ReachOf(LightConstants light) {
  Sphere reach;
  reach.center = light.position;
  reach.radius = light.range;
  if (light.is_spot == 0 || light.cos_outer <= kWidestMap) return reach;
  const bool is_narrow = light.cos_outer > 0.70710678;
  const float along = is_narrow ? 0.5 / light.cos_outer : light.cos_outer;
  reach.center += light.direction * (along * light.range);
  reach.radius *= is_narrow ? along : sqrt(1.0 - light.cos_outer * light.cos_outer);
  return reach;
}

// The same with a margin for the rounding of positions and bounds.
Sphere SafeReachOf(LightConstants light) {
  Sphere reach = ReachOf(light);
  reach.radius = reach.radius * 1.0001 + 1e-4 * length(reach.center);
  return reach;
}

// Tells whether the sphere reaches into what the camera sees: the pyramid or prism of its picture,
// without an end. It is a little wider, for the jitter of rays within their pixels.
bool ReachesPicture(Sphere reach) {
  const float x = dot(reach.center, frame.camera_right) * frame.over_right;
  const float y = dot(reach.center, frame.camera_up) * frame.over_up;
  const float z = dot(reach.center, frame.camera_forward);
  const float half_width = 1.02 / frame.over_right, half_height = 1.02 / frame.over_up;
  if (!(z > -reach.radius)) return false;
  if (frame.is_orthographic != 0) {
    return abs(x) <= half_width + reach.radius && abs(y) <= half_height + reach.radius;
  }
  // Distance from the sides, positive inside.
  const float across = half_width * z - abs(x), down = half_height * z - abs(y);
  return across >= -reach.radius * sqrt(1.0 + half_width * half_width) &&
         down >= -reach.radius * sqrt(1.0 + half_height * half_height);
}

#endif
