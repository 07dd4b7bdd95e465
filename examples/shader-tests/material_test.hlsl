// SPDX-License-Identifier: MIT
// Shaders that are called alone: a closest-hit, an any-hit, an intersection, a miss and a callable
// shader, each with the record, the attributes and the payload that the test gives it.
#include <kaamos/test.hlsli>

// Two materials: colour and roughness, which are the constants of a local root signature.
#pragma kaamos record Painted (0.5, 0.25, 0.125) (0.75)
#pragma kaamos record Painted (0.0, 0.0, 1.0) (0.25)

struct Payload {
  float3 color;
  float roughness;
};

cbuffer Color : register(b0, space1) { float3 base_color; };
cbuffer Finish : register(b1, space1) { float roughness; };

LocalRootSignature Material = {
    "RootConstants(num32BitConstants=3, b0, space=1), RootConstants(num32BitConstants=1, b1, space=1)"};
SubobjectToExportsAssociation OfPainted = {"Material", "Painted"};

[shader("closesthit")]
void Paint(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color = base_color * (1 - attributes.barycentrics.x);
  payload.roughness = roughness;
}

// Half of the triangle is cut away.
[shader("anyhit")]
void CutCorner(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.roughness += 1;
  if (attributes.barycentrics.x + attributes.barycentrics.y > 0.5) IgnoreHit();
}

[shader("closesthit")]
void Mark(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color = float3(HitKind() == HIT_KIND_TRIANGLE_FRONT_FACE, RayTCurrent(), PrimitiveIndex());
}

struct Depth {
  float inside;
};

// The ray's way through a slab of height 1.
[shader("intersection")]
void Slab() {
  const float near = (0.5 - ObjectRayOrigin().y) / ObjectRayDirection().y;
  const float far = (-0.5 - ObjectRayOrigin().y) / ObjectRayDirection().y;
  const Depth depth = {abs(far - near)};
  ReportHit(min(near, far), 7, depth);
}

[shader("closesthit")]
void Fog(inout Payload payload, Depth depth) {
  payload.color = exp(-depth.inside);
  payload.roughness = HitKind();
}

TriangleHitGroup Painted = {"", "Paint"};
TriangleHitGroup Cut = {"CutCorner", "Mark"};
ProceduralPrimitiveHitGroup Haze = {"", "Fog", "Slab"};

[shader("miss")]
void Sky(inout Payload payload) {
  payload.color = lerp(float3(1, 1, 1), float3(0, 0, 1), saturate(WorldRayDirection().y));
}

struct Noise {
  uint seed;
};

[shader("callable")]
void NextSeed(inout Noise noise) {
  noise.seed = noise.seed * 1664525 + 1013904223;
}

[test("raygeneration")]
void PaintIsTheRecordsColour() {
  Payload payload = {float3(0, 0, 0), 0};
  CallHitGroup(HIT_GROUP(Painted), float2(0.5, 0.25), payload);
  EXPECT_EQ(payload.color, float3(0.25, 0.125, 0.0625));
  EXPECT_EQ(payload.roughness, 0.75);
  CallHitGroup(HIT_GROUP(Painted) + 1, float2(0, 0.25), payload);
  EXPECT_EQ(payload.color, float3(0, 0, 1));
  EXPECT_EQ(payload.roughness, 0.25);
}

[test("raygeneration")]
[cases((0.125, 0.125, 1), (0.25, 0.5, 0))]
void TheCornerIsCutAway(float u, float v, float there) {
  Payload payload = {float3(0, 9, 9), 0};
  CallHitGroup(HIT_GROUP(Cut), float2(u, v), payload);
  EXPECT_EQ(payload.roughness, 1);  // the any-hit shader ran once
  EXPECT_EQ(payload.color, there != 0 ? float3(1, 1, 0) : float3(0, 9, 9));
}

[test("raygeneration")]
void OpaqueTrianglesAreNotCut() {
  Payload payload = {float3(0, 0, 0), 0};
  CallHitGroup(HIT_GROUP(Cut), float2(0.25, 0.5), payload, RAY_FLAG_FORCE_OPAQUE);
  EXPECT_EQ(payload.roughness, 0);
  EXPECT_EQ(payload.color.x, 1);
}

[test("raygeneration")]
void TheWayThroughTheHazeCounts() {
  const RayDesc down = {float3(0, 2, 0), 0, float3(0, -1, 0), 10};
  Payload payload = {float3(0, 0, 0), 0};
  CallProceduralHitGroup(HIT_GROUP(Haze), down, payload);
  EXPECT_NEAR(payload.color, exp(-1.0), 1e-6);
  EXPECT_EQ(payload.roughness, 7);
  const RayDesc slanted = {float3(-0.8, 1, 0), 0, float3(0.8, -1, 0), 10};
  CallProceduralHitGroup(HIT_GROUP(Haze), slanted, payload);
  EXPECT_NEAR(payload.color, exp(-1.0), 1e-6);
}

[test("raygeneration")]
[cases((0, 1), (1, 0), (-1, 1))]
void TheSkyIsBlueAbove(float up, float red) {
  const RayDesc ray = {float3(0, 0, 0), 0, float3(0.5, up, 0), 1};
  Payload payload = {float3(0, 0, 0), 3};
  CallMiss(MISS(Sky), ray, payload);
  EXPECT_NEAR(payload.color.r, red, 1e-6);
  EXPECT_EQ(payload.roughness, 3);
}

[test("raygeneration")]
void SeedsFollowEachOther() {
  Noise noise = {1};
  CallShader(CALLABLE(NextSeed), noise);
  EXPECT_EQ(noise.seed, 1015568748u);
}
