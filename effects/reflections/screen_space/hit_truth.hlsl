// SPDX-License-Identifier: MIT
// Finds what the rays of screen-space reflections hit in the scene, and how the picture shows that.
// This tells in which ways a march over the picture fails.
#include "alpha_test.hlsli"
#include "screen_constants.hlsli"
#include "screen_ray.hlsli"
#include "surface.hlsli"

ConstantBuffer<ScreenReflectionConstants> constants : register(b0, space3);
RWTexture2D<float4> hits : register(u1, space3);   // of screen_reflections.hlsl
// The distance at which the ray hits (metres), how the picture shows what it hits, the instance + 1
// of that, and whether the march found the same.
RWTexture2D<float4> truth : register(u2, space3);

// effects/reflections/screen_space/hit_comparison.h has the same numbers.
static const uint kNoTruth = 0;     // there is no ray
static const uint kNothing = 1;     // it hits nothing
static const uint kSeen = 2;        // the picture shows the place
static const uint kOutside = 3;     // it lies outside the picture, or behind the camera
static const uint kCovered = 4;     // something else is in front of it
static const uint kTurnedAway = 5;  // the ray hits a side that the camera cannot see

static const float kSameDistance = 0.02;  // of the distance
static const float kSamePlace = 0.01;     // of the view depth: how far off a pixel's plane

struct TruthPayload {
  float distance;  // negative: a miss
  uint instance;   // + 1
  float3 normal;   // towards the ray's origin
};

[shader("miss")]
void TruthMiss(inout TruthPayload payload) {
  payload.distance = -1.0;
}

[shader("anyhit")]
void TruthAnyHit(inout TruthPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

[shader("closesthit")]
void TruthHit(inout TruthPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const HitPoint found = LoadHitPoint(vertices, indices, RayHit(hit.barycentrics));
  payload.distance = RayTCurrent();
  payload.instance = InstanceIndex() + 1;
  payload.normal = found.side * found.spawn.normal;
}

// Tells whether a pixel shows a point of an instance. At edges it may be a neighbour.
bool ShowsPlace(float2 place, float3 position, float view_z, uint instance, float2 size) {
  for (int i = 0; i < 9; ++i) {
    const int2 pixel = clamp(int2(place) + int2(i % 3 - 1, i / 3 - 1), int2(0, 0), int2(size) - 1);
    if (g_ids[pixel].x != instance) continue;
    const float3 apart = position - g_position[pixel].xyz;
    if (abs(dot(apart, OctahedralDecode(g_normal[pixel]))) <= kSamePlace * view_z) return true;
  }
  return false;
}

uint HowSeen(float3 position, float3 normal, uint instance, float2 size) {
  const float view_z = dot(position, frame.camera_forward);
  if (!(view_z > frame.near_plane)) return kOutside;
  const float2 place = PlaceOf(position, size);
  if (!IsInPicture(place, size)) return kOutside;
  if (!(dot(normal, position) < 0.0)) return kTurnedAway;
  return ShowsPlace(place, position, view_z, instance, size) ? kSeen : kCovered;
}

[shader("raygeneration")]
void HitTruth() {
  const uint2 pixel = FramePixel();
  truth[pixel] = float4(0, float(kNoTruth), 0, 0);
  if (g_ids[pixel].x == 0) return;
  const ReflectionPoint surface = LoadReflectionPoint(pixel);
  const ReflectionRay sample = SampleReflectionRay(pixel, surface, LengthsOf(constants),
                                                   pass_constants.first_sample, frame.seed);
  if (!sample.exists) return;
  RayDesc ray;
  ray.Origin = surface.origin;
  ray.TMin = 0.0;
  ray.Direction = sample.direction;
  ray.TMax = sample.length;
  TruthPayload payload;
  payload.distance = -1.0;
  payload.instance = 0;
  payload.normal = float3(0, 0, 0);
  TraceRay(scene, RAY_FLAG_NONE, ReflectionMask(surface.roughness), kRayTypeSurface, kRayTypeCount,
           kRayTypeSurface, ray, payload);
  if (payload.distance < 0.0) {
    truth[pixel] = float4(0, float(kNothing), 0, 0);
    return;
  }
  const float3 position = ray.Origin + ray.Direction * payload.distance;
  const float2 size = PictureSize();
  const float4 found = hits[pixel];
  const int2 hit_pixel = clamp(int2(found.xy), int2(0, 0), int2(size) - 1);
  const bool is_right = uint(found.w) == kHit && g_ids[hit_pixel].x == payload.instance &&
                        abs(found.z - payload.distance) <= kSameDistance * payload.distance;
  truth[pixel] = float4(payload.distance,
                        float(HowSeen(position, payload.normal, payload.instance, size)),
                        float(payload.instance), is_right ? 1.0 : 0.0);
}
