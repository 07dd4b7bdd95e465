// SPDX-License-Identifier: MIT
// Visibility between two horizons. A slice is a half plane through the view ray and its opposite;
// in it, angles are measured from the direction to the camera.
#ifndef KAAMOS_HORIZONS_HLSLI
#define KAAMOS_HORIZONS_HLSLI

static const float kHalfPi = 1.57079632679;

// The arc cosine of what rounding may have taken out of -1..1.
float SafeAcos(float x) { return acos(max(-1.0f, min(x, 1.0f))); }

// Returns what the part of a slice from the camera's direction to the horizon `h` receives,
// weighted by the cosine to a normal at the angle `gamma`, over that of an open half plane.
// [Jimenez et al. 2016, Practical Realtime Strategies for Accurate Indirect Occlusion, with the
// sign that the survey lost put back: effects/SOURCES.md, E5]
float ArcVisibility(float h, float gamma) {
  return 0.25f * (cos(gamma) + 2.0f * h * sin(gamma) - cos(2.0f * h - gamma));
}

// The same for both parts. `h0` <= 0 <= `h1` are the horizons; none reaches behind the surface.
float SliceVisibility(float h0, float h1, float gamma) {
  const float low = max(h0, gamma - kHalfPi);
  const float high = min(h1, gamma + kHalfPi);
  return ArcVisibility(low, gamma) + ArcVisibility(high, gamma);
}

// The integral of ArcVisibility's weight times the direction, for bent normals: along the slice's
// direction, and along that to the camera.
float2 ArcBend(float h, float gamma) {
  const float third = sin(3.0f * h - gamma) + sin(gamma);
  const float along = 0.5f * (sin(h - gamma) + sin(gamma)) -
                      0.25f * (third / 3.0f + sin(h + gamma) - sin(gamma));
  const float towards = 0.25f * ((cos(gamma) - cos(3.0f * h - gamma)) / 3.0f + cos(gamma) -
                                 cos(h + gamma));
  return float2(along, towards);
}

// The same for both parts, as SliceVisibility.
float2 SliceBend(float h0, float h1, float gamma) {
  const float low = max(h0, gamma - kHalfPi);
  const float high = min(h1, gamma + kHalfPi);
  return ArcBend(low, gamma) + ArcBend(high, gamma);
}

float WithBounces(float visibility, float albedo) {
  const float a = 2.0404f * albedo - 0.3324f;
  const float b = -4.7951f * albedo + 0.6417f;
  const float c = 2.7552f * albedo + 0.6903f;
  const float lit = ((visibility * a + b) * visibility + c) * visibility;
  return min(max(visibility, lit), 1.0f);
}

// Visibility and the light that occluders reflect, if they are as bright as the surface itself:
// a cubic that was fitted to traced scenes. [Jimenez et al. 2016]
float3 MultiBounce(float visibility, float3 albedo) {
  return float3(WithBounces(visibility, albedo.x), WithBounces(visibility, albedo.y),
                WithBounces(visibility, albedo.z));
}

// A normal as a slice sees it.
struct SliceNormal {
  float length;  // of its projection into the slice
  float gamma;   // angle from the camera's direction towards the slice's direction
};

// `direction` and `to_camera` are unit vectors square to each other.
SliceNormal ProjectNormal(float3 normal, float3 direction, float3 to_camera) {
  const float along = dot(normal, direction);
  // A normal that faces away counts as one from the side.
  const float towards = max(dot(normal, to_camera), 0.0f);
  SliceNormal slice;
  slice.length = sqrt(along * along + towards * towards);
  slice.gamma = 0.0f;
  if (slice.length > 1e-6f) {
    const float angle = SafeAcos(towards / slice.length);
    slice.gamma = along < 0.0f ? -angle : angle;
  }
  return slice;
}

#endif
