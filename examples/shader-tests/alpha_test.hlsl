// SPDX-License-Identifier: MIT
// An any-hit shader that cuts holes: which rays it lets through, and what it costs.
#include <kaamos/test.hlsli>

// A fence of two triangles at z = 5, 4 units wide and high, and a wall behind it at z = 9.
#pragma kaamos geometry fence triangles (-2,-2,0) (2,-2,0) (-2,2,0)  (2,2,0) (-2,2,0) (2,-2,0)
#pragma kaamos geometry wall triangles opaque (-9,-9,0) (9,-9,0) (0,18,0)
#pragma kaamos instance fence at (0,0,5) hit_group 0 mask 0x1
#pragma kaamos instance wall at (0,0,9) hit_group 1 mask 0x3 id 1

struct Payload {
  float t;
  uint any_hits;
};

// Every other square of 1/8 of a triangle's side is a hole.
[shader("anyhit")]
void Holes(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  ++payload.any_hits;
  const uint2 square = uint2(attributes.barycentrics * 8);
  if (((square.x + square.y) & 1) != 0) IgnoreHit();
}

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.t = RayTCurrent();
}

[shader("miss")]
void Miss(inout Payload payload) {
  payload.t = -1;
}

TriangleHitGroup Fence = {"Holes", "Hit"};
TriangleHitGroup Wall = {"", "Hit"};

Payload trace(float2 at, uint flags, uint mask) {
  RayDesc ray = {float3(at, 0), 0, float3(0, 0, 1), 100};
  Payload payload = {0, 0};
  TraceRay(TestScene, flags, mask, 0, 0, 0, ray, payload);
  return payload;
}

// The corner of the first triangle is where both barycentrics are 0.
[test("raygeneration")]
[cases((-1.9, -1.9, 5), (-1.4, -1.9, 9), (-0.9, -1.9, 5), (-1.4, -1.4, 5))]
void SquaresAlternate(float x, float y, float expected) {
  const Payload payload = trace(float2(x, y), 0, 0xFF);
  EXPECT_NEAR(payload.t, expected, 1e-5);
  EXPECT_EQ(payload.any_hits, 1);
}

[test("raygeneration")]
void OpaqueRaysDoNotAsk() {
  const Payload payload = trace(float2(-1.4, -1.9), RAY_FLAG_FORCE_OPAQUE, 0xFF);
  EXPECT_NEAR(payload.t, 5, 1e-5);
  EXPECT_EQ(payload.any_hits, 0);
}

[test("raygeneration")]
void MasksLeaveTheFenceOut() {
  const Payload payload = trace(float2(-1.9, -1.9), 0, 0x2);
  EXPECT_NEAR(payload.t, 9, 1e-5);
  EXPECT_EQ(payload.any_hits, 0);
}

// Rays on a grid, one a thread, none on the edge that the triangles share: each finds the fence or
// the wall.
[test("raygeneration")]
[dispatch(32, 32)]
void EveryRayFindsOneOfThem() {
  const float2 at = (DispatchRaysIndex().xy + float2(0.5, 0.25)) / 32 * 4 - 2;
  const Payload payload = trace(at, 0, 0xFF);
  EXPECT_TRUE(payload.t == 5 || payload.t == 9);
  EXPECT_EQ(payload.any_hits, 1);
}
