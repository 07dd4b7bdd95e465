// SPDX-License-Identifier: MIT
// What points of the scene see, from which the host chooses those that probes stand at: how far away
// everything is, and which other points are in sight. [effects/reflections/environment_map/probe_places.h]
#ifndef KAAMOS_PROBE_SIGHTS_HLSLI
#define KAAMOS_PROBE_SIGHTS_HLSLI

#include "alpha_test.hlsli"

StructuredBuffer<float4> sight_points : register(t6, space3);
// A row for each point: its sights, face by face, then whether it sees each point.
RWStructuredBuffer<float4> sights : register(u21, space3);

static const uint kSightSide = 8;  // rays along the side of a face
static const uint kSightsOfFace = kSightSide * kSightSide;
static const uint kSightsOfPoint = 6 * kSightsOfFace;
static const float kFacing = 0.9;  // cosine with a face's axis from which on a surface is a wall

static const uint kMaskBaked = 0x20;  // what stands still [effects/assets/scene/scene.h: InstanceMask]

// The direction of a place on a face of a cube, 0..1. [D3D11.3 7.18.11]
float3 FaceDirection(uint face, float2 uv) {
  const float2 p = uv * 2.0 - 1.0;
  if (face == 0) return float3(1.0, -p.y, -p.x);
  if (face == 1) return float3(-1.0, -p.y, p.x);
  if (face == 2) return float3(p.x, 1.0, p.y);
  if (face == 3) return float3(p.x, -1.0, -p.y);
  if (face == 4) return float3(p.x, -p.y, 1.0);
  return float3(-p.x, -p.y, -1.0);
}

struct SightPayload {
  float distance;  // in lengths of the ray's direction; negative: nothing is there
  float3 normal;
};

[shader("miss")]
void SightMiss(inout SightPayload payload) {
  payload.distance = -1.0;
}

[shader("anyhit")]
void SightAnyHit(inout SightPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

[shader("closesthit")]
void SightClosestHit(inout SightPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  payload.distance = RayTCurrent();
  payload.normal = LoadHitPoint(vertices, indices, RayHit(hit.barycentrics)).spawn.normal;
}

SightPayload Look(float3 origin, float3 direction, float t_max) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0.0;
  ray.Direction = direction;
  ray.TMax = t_max;
  SightPayload payload;
  payload.distance = -1.0;
  payload.normal = float3(0, 0, 0);
  TraceRay(scene, RAY_FLAG_NONE, kMaskBaked, kRayTypeSurface, kRayTypeCount, kRayTypeSurface, ray,
           payload);
  return payload;
}

// x: distance along the face's axis, 0: nothing is there; y: 1: a wall, which faces that axis; z:
// distance. Of points: x: 1: in sight.
[shader("raygeneration")]
void LookAround() {
  const uint point_index = DispatchRaysIndex().y;
  const uint i = DispatchRaysIndex().x;
  const float3 from = sight_points[point_index].xyz;
  float4 seen = float4(0, 0, 0, 0);
  if (i < kSightsOfPoint) {
    const uint face = i / kSightsOfFace;
    const uint2 cell = uint2(i % kSightSide, (i % kSightsOfFace) / kSightSide);
    const float3 direction = FaceDirection(face, (float2(cell) + 0.5) / float(kSightSide));
    const SightPayload payload = Look(from, direction, kLongestRay);
    if (payload.distance > 0.0) {
      seen = float4(payload.distance, abs(payload.normal[face / 2]) >= kFacing ? 1.0 : 0.0,
                    payload.distance * length(direction), 0.0);
    }
  } else {
    const float3 way = sight_points[i - kSightsOfPoint].xyz - from;
    const bool is_free = !any(way != 0.0) || Look(from, way, 1.0).distance < 0.0;
    seen.x = is_free ? 1.0 : 0.0;
  }
  sights[point_index * DispatchRaysDimensions().x + i] = seen;
}

#endif
