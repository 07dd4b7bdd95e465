// SPDX-License-Identifier: MIT
// Shaders that call each other as deep as a constant says.
RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer words : register(u0);

cbuffer Root : register(b0) {
  uint limit;  // levels
};

struct Level {
  uint value;
};

RayDesc straight() {
  RayDesc ray;
  ray.Origin = float3(0.1, 0.2, 0);
  ray.TMin = 0;
  ray.Direction = float3(0, 0, 1);
  ray.TMax = 1000;
  return ray;
}

// Writes the number of levels that ran, plus one.
[shader("raygeneration")]
void TraceDeep() {
  Level level;
  level.value = 0;
  if (limit > 0) TraceRay(scene, 0, 0xFF, 0, 0, 0, straight(), level);
  words.Store(0, level.value + 1);
}

[shader("raygeneration")]
void TraceSkipping() {
  Level level;
  level.value = 0;
  TraceRay(scene, RAY_FLAG_SKIP_TRIANGLES, 0xFF, 0, 0, 0, straight(), level);
  words.Store(0, level.value + 1);
}

[shader("closesthit")]
void HitDeep(inout Level level, BuiltInTriangleIntersectionAttributes attributes) {
  level.value += 1;
  if (level.value < limit) TraceRay(scene, 0, 0xFF, 0, 0, 0, straight(), level);
}

[shader("closesthit")]
void HitQuery(inout Level level, BuiltInTriangleIntersectionAttributes attributes) {
  RayQuery<RAY_FLAG_FORCE_OPAQUE> query;
  query.TraceRayInline(scene, 0, 0xFF, straight());
  query.Proceed();
  level.value = query.CommittedStatus() == COMMITTED_TRIANGLE_HIT ? 20 : 10;
}

[shader("raygeneration")]
void CallDeep() {
  Level level;
  level.value = 0;
  CallShader(0, level);
  words.Store(0, level.value + 1);
}

[shader("callable")]
void Deeper(inout Level level) {
  level.value += 1;
  if (level.value < limit) CallShader(0, level);
}
