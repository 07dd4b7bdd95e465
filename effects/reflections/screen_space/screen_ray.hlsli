// SPDX-License-Identifier: MIT
// A ray over the picture, and what a march along it can find: set-up, clipping, validation and the
// ways in which it fails, the same for every march. [survey 6.2; McGuire & Mara 2014]
#ifndef KAAMOS_SCREEN_RAY_HLSLI
#define KAAMOS_SCREEN_RAY_HLSLI

#include "frame.hlsli"

// Outcomes of a march. effects/reflections/screen_space/hit_comparison.h has the same numbers.
static const uint kNoRay = 0;       // sky, or a direction below the surface
static const uint kHit = 1;
static const uint kOffScreen = 2;   // the ray left the picture, or came behind the near plane
static const uint kHidden = 3;      // it passed behind a surface: what is there the camera cannot see
static const uint kBackFacing = 4;  // it met only sides of surfaces that face away from the camera
static const uint kEnded = 5;       // it ended over a surface, in front of it
static const uint kSky = 6;         // it ended over the sky, or in front of nothing else
static const uint kStale = 7;       // it hit what the previous frame does not show
static const uint kOutOfSteps = 8;  // the march ended before the ray did
static const uint kNotLookedFor = 9;  // no march was sent, or its hit is not to be used

static const float kSkyZ = 1e30;  // view depth of the sky, metres

float2 PictureSize() {
  uint width, height;
  g_view_z.GetDimensions(width, height);
  return float2(width, height);
}

// Returns where the camera sees a point in front of it, in pixels from the upper left corner;
// centres of pixels are at .5.
float2 PlaceOf(float3 position, float2 size) {
  float view_z;
  return PictureUv(position, frame.camera_right, frame.over_right, frame.camera_up, frame.over_up,
                   frame.camera_forward, view_z) * size - frame.jitter;
}

bool IsInPicture(float2 place, float2 size) {
  return all(place >= float2(0, 0)) && all(place < size);
}

// The view depth that a pixel shows.
float SceneDepth(int2 pixel) {
  const float view_z = g_view_z[pixel];
  return view_z > 0.0 ? view_z : kSkyZ;
}

// A ray as the picture shows it: a line of pixels along which 1 / view depth and distance / view
// depth are linear. Parameter s runs from 0 to 1 over the part that can be seen. [McGuire & Mara
// 2014, Efficient GPU Screen-Space Ray Tracing]
struct ScreenRay {
  float3 origin;     // relative to the camera
  float3 direction;  // unit
  float2 from;       // pixels
  float2 along;      // pixels, from there to the end
  float from_k;      // 1 / view depth
  float along_k;
  float from_tk;     // distance / view depth
  float along_tk;
  bool is_cut;       // it leaves the picture or passes the near plane before it ends
  bool exists;       // false: its origin cannot be seen, or it is no line
};

float2 ScreenPlace(ScreenRay ray, float s) { return ray.from + ray.along * s; }
float ScreenDepth(ScreenRay ray, float s) { return 1.0 / (ray.from_k + ray.along_k * s); }
float ScreenDistance(ScreenRay ray, float s) {
  return (ray.from_tk + ray.along_tk * s) / (ray.from_k + ray.along_k * s);
}
// The inverse: where a point of the ray is.
float ScreenParameter(ScreenRay ray, float distance) {
  const float below = ray.along_tk - distance * ray.along_k;
  return below != 0.0 ? (distance * ray.from_k - ray.from_tk) / below : 0.0;
}

// Returns how far along `direction` a point stays in 0..size; 1: all the way.
float ClipAxis(float from, float direction, float size) {
  if (direction > 0.0) return min(1.0, (size - from) / direction);
  if (direction < 0.0) return min(1.0, -from / direction);
  return 1.0;
}

ScreenRay MakeScreenRay(float3 origin, float3 direction, float length, float2 size) {
  ScreenRay ray;
  ray.origin = origin;
  ray.direction = direction;
  const float depth = dot(origin, frame.camera_forward);
  const float slope = dot(direction, frame.camera_forward);
  const float near = frame.near_plane;
  ray.from = float2(0, 0);
  ray.along = float2(0, 0);
  ray.from_k = 1.0;
  ray.along_k = ray.from_tk = ray.along_tk = 0.0;
  ray.is_cut = false;
  ray.exists = depth > near && length > 0.0;
  if (!ray.exists) return ray;
  // The near plane first: behind the camera nothing can be projected.
  float end = length;
  if (depth + slope * end < near) {
    end = (near - depth) / slope;
    ray.is_cut = true;
  }
  ray.from = PlaceOf(origin, size);
  ray.from_k = 1.0 / depth;
  const float end_k = 1.0 / max(depth + slope * end, near);
  ray.along = PlaceOf(origin + direction * end, size) - ray.from;
  ray.along_k = end_k - ray.from_k;
  ray.along_tk = end * end_k;
  // A ray towards or away from the camera is a point; so that a march can divide by its length.
  if (dot(ray.along, ray.along) < 1e-4) ray.along = float2(0.01, 0.0);
  const float part = max(0.0, min(ClipAxis(ray.from.x, ray.along.x, size.x),
                                  ClipAxis(ray.from.y, ray.along.y, size.y)));
  if (part < 1.0) {
    ray.is_cut = true;
    ray.along *= part;
    ray.along_k *= part;
    ray.along_tk *= part;
  }
  ray.exists = part > 0.0 && IsInPicture(ray.from, size) &&
               dot(ray.along, ray.along) < kLongestRay;
  return ray;
}

// The result of a march, and what it met on its way.
struct ScreenHit {
  uint outcome;
  float distance;   // along the ray, metres
  float2 place;     // pixels
  int2 pixel;       // whose surface is hit
};

// The rule by which surfaces are met.
struct ScreenRule {
  float thickness;     // metres that a surface is taken to reach back
  float step_thickness;  // and besides, in depths of the step that meets it
  bool strict;         // only hits that leave no doubt
  bool without_lamps;  // the ray passes through the shapes of lamps
  uint own_instance;   // that the ray starts on
};

struct MarchState {
  bool passed_behind;  // a surface
  bool met_back;       // a surface that faces away
};

// Returns how far along the ray the plane of a pixel's surface is; negative: not in front of that
// side.
float DistanceToSurface(ScreenRay ray, int2 pixel) {
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  const float facing = dot(ray.direction, normal);
  if (!(facing < 0.0)) return -1.0;
  return dot(g_position[pixel].xyz - ray.origin, normal) / facing;
}

// Tells whether the surface of a pixel, which the ray crosses in depth between s0 and s1, is hit.
// The point is moved onto the surface's plane, since a pixel's depth is that of its centre alone.
bool AcceptHit(ScreenRay ray, ScreenRule rule, int2 pixel, float s0, float s1,
               inout MarchState state, inout ScreenHit hit) {
  const float to_plane = DistanceToSurface(ray, pixel);
  if (!(to_plane > 0.0)) {
    // The plane that the ray started on is behind it all along.
    if (g_ids[pixel].x != rule.own_instance) state.met_back = true;
    return false;
  }
  if (rule.strict) {
    const float s = ScreenParameter(ray, to_plane);
    const float2 place = ScreenPlace(ray, s);
    if (!(s > 0.0) || !(s <= 1.0) || any(abs(place - float2(pixel) - 0.5) > 1.0)) return false;
  }
  hit.outcome = kHit;
  hit.pixel = pixel;
  hit.distance = to_plane;
  if (!rule.strict) {
    hit.distance = clamp(to_plane, ScreenDistance(ray, s0), ScreenDistance(ray, s1));
  }
  hit.place = ScreenPlace(ray, saturate(ScreenParameter(ray, hit.distance)));
  return true;
}

// Returns the outcome of a march that went all the way without a hit.
uint MissOutcome(ScreenRay ray, MarchState state, float2 size) {
  if (state.passed_behind) return kHidden;
  if (ray.is_cut) return kOffScreen;
  if (state.met_back) return kBackFacing;
  const int2 last = clamp(int2(ScreenPlace(ray, 1.0)), int2(0, 0), int2(size) - 1);
  return SceneDepth(last) == kSkyZ ? kSky : kEnded;
}

#endif
