// SPDX-License-Identifier: MIT
// Payloads, attributes and callable parameters.
#include "standard.hlsl"

struct Small {
  uint value;
};

struct NineWords {
  uint values[9];
};

struct Wide {
  uint values[64];
};

// Two ray types with a payload type each.
[shader("raygeneration")]
void TraceTwoTypes() {
  Seen seen = nothingSeen();
  TraceRay(scene, 0, 0xFF, 0, 0, 0, describe(rays[0]), seen);
  Small small;
  small.value = 40;
  TraceRay(scene, 0, 0xFF, 1, 0, 1, describe(rays[0]), small);
  Small missed;
  missed.value = 50;
  TraceRay(scene, 0, 0, 1, 0, 1, describe(rays[0]), missed);
  words.Store(0, seen.end);
  words.Store(4, small.value);
  words.Store(8, missed.value);
}

[shader("closesthit")]
void ClosestSmall(inout Small small, BuiltInTriangleIntersectionAttributes attributes) {
  small.value += 1;
}

[shader("miss")]
void MissSmall(inout Small small) {
  small.value += 2;
}

[shader("raygeneration")]
void CallWide() {
  Wide wide = (Wide)0;
  for (uint i = 0; i < 64; ++i) wide.values[i] = i;
  CallShader(0, wide);
  for (uint k = 0; k < 64; ++k) words.Store(4 * k, wide.values[k]);
}

[shader("callable")]
void Widen(inout Wide wide) {
  Wide inner = wide;
  for (uint i = 0; i < 64; ++i) inner.values[i] *= 2;
  CallShader(1, inner);
  for (uint k = 0; k < 64; ++k) wide.values[k] += inner.values[k];
}

[shader("callable")]
void Increase(inout Wide wide) {
  for (uint i = 0; i < 64; ++i) wide.values[i] += 1000;
}

[shader("miss")]
void MissNine(inout NineWords nine) {
  nine.values[0] = 1;
}

struct FourFloats {
  float values[4];
};

[shader("intersection")]
void ReportFour() {
  FourFloats four = (FourFloats)0;
  ReportHit(5, 0, four);
}

[shader("closesthit")]
void ClosestFour(inout Seen seen, FourFloats attributes) {
  seen.end = 1;
}

// Notes how many any-hit shaders have run as far as it sees, and adds one.
[shader("closesthit")]
void ClosestOfChain(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  seen.end = 1;
  seen.record = seen.anyHits;
  seen.anyHits += 1000;
}

[shader("miss")]
void MissOfChain(inout Seen seen) {
  seen.end = 2;
  seen.record = seen.anyHits;
  seen.anyHits += 1000;
}

// Passes on its own payload; a copy keeps the old contents.
[shader("closesthit")]
void Forwards(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  seen.geometry = 7;
  const Seen copy = seen;
  RayDesc ray;
  ray.Origin = WorldRayOrigin() + (RayTCurrent() + 1) * WorldRayDirection();
  ray.TMin = 0;
  ray.Direction = WorldRayDirection();
  ray.TMax = 1000;
  TraceRay(scene, 0, 0xFF, 1, 0, 0, ray, seen);
  seen.anyRecord = copy.geometry;
  seen.boxRecord = copy.end;
}
