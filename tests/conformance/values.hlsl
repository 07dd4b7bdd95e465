// SPDX-License-Identifier: MIT
// System values, each written where a word says.
#include "standard.hlsl"

struct Echo {
  uint depth;
  uint3 index;
  uint3 dimensions;
  uint3 calledIndex;
  uint3 calledDimensions;
};

RayDesc straight() {
  RayDesc ray;
  ray.Origin = float3(0.1, 0.2, 0);
  ray.TMin = 0;
  ray.Direction = float3(0, 0, 1);
  ray.TMax = 1000;
  return ray;
}

// Three nested traces, then a callable.
[shader("raygeneration")]
void EchoGrid() {
  Echo echo = (Echo)0;
  TraceRay(scene, 0, 0xFF, 0, 0, 0, straight(), echo);
  const uint3 at = DispatchRaysIndex();
  const uint3 size = DispatchRaysDimensions();
  words.Store<Echo>(52 * (at.x + size.x * (at.y + size.y * at.z)), echo);
}

[shader("closesthit")]
void EchoDeep(inout Echo echo, BuiltInTriangleIntersectionAttributes attributes) {
  echo.depth += 1;
  if (echo.depth < 3) {
    TraceRay(scene, 0, 0xFF, 0, 0, 0, straight(), echo);
    return;
  }
  echo.index = DispatchRaysIndex();
  echo.dimensions = DispatchRaysDimensions();
  CallShader(0, echo);
}

[shader("callable")]
void EchoCall(inout Echo echo) {
  echo.calledIndex = DispatchRaysIndex();
  echo.calledDimensions = DispatchRaysDimensions();
}

static const uint kAnyHitWords = 20000;
static const uint kClosestHitWords = 21000;
static const uint kMissWords = 22000;
static const uint kIntersectionWords = 23000;
static const uint kObjectWords = 24000;

void writeWorldRay(uint at) {
  words.Store<float3>(at, WorldRayOrigin());
  words.Store<float3>(at + 12, WorldRayDirection());
  words.Store<float>(at + 24, RayTMin());
}

[shader("anyhit")]
void AnyRay(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  writeWorldRay(kAnyHitWords);
}

[shader("closesthit")]
void ClosestRay(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  writeWorldRay(kClosestHitWords);
  seen.barycentrics = attributes.barycentrics;
  seen.t = RayTCurrent();
  words.Store<float3>(kObjectWords, ObjectRayOrigin());
  words.Store<float3>(kObjectWords + 12, ObjectRayDirection());
  const float3x4 toWorld = ObjectToWorld3x4();
  const float3x4 toObject = WorldToObject3x4();
  const float4x3 toWorldTransposed = ObjectToWorld4x3();
  const float4x3 toObjectTransposed = WorldToObject4x3();
  for (uint row = 0; row < 3; ++row) {
    for (uint column = 0; column < 4; ++column) {
      const uint at = kObjectWords + 24 + 4 * (4 * row + column);
      words.Store<float>(at, toWorld[row][column]);
      words.Store<float>(at + 48, toObject[row][column]);
      words.Store<float>(at + 96, toWorldTransposed[column][row]);
      words.Store<float>(at + 144, toObjectTransposed[column][row]);
    }
  }
}

[shader("miss")]
void MissRay(inout Seen seen) {
  writeWorldRay(kMissWords);
}

[shader("intersection")]
void BoxRay() {
  writeWorldRay(kIntersectionWords);
}

struct ThreeFloats {
  float3 values;
};

[shader("closesthit")]
void ClosestTooLarge(inout Seen seen, ThreeFloats attributes) {
  seen.end = 1;
}
