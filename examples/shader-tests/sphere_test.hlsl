// SPDX-License-Identifier: MIT
// An intersection shader: distances, normals, and rays that start inside or graze.
#include <kaamos/test.hlsli>

#pragma kaamos geometry ball boxes (-1,-1,-1) (1,1,1)
#pragma kaamos instance ball at (0,0,5)
#pragma kaamos instance ball transform (3,0,0,20, 0,3,0,0, 0,0,3,5) id 1

struct Attributes {
  float3 normal;
};
struct Payload {
  float t;
  float3 normal;
};

[shader("intersection")]
void Sphere() {
  const float3 o = ObjectRayOrigin();
  const float3 d = ObjectRayDirection();
  const float a = dot(d, d);
  const float b = dot(o, d);
  const float discriminant = b * b - a * (dot(o, o) - 1);
  if (discriminant < 0) return;
  const float root = sqrt(discriminant);
  const float near = (-b - root) / a;
  const float far = (-b + root) / a;
  const float t = near >= RayTMin() ? near : far;
  Attributes attributes = {o + t * d};
  ReportHit(t, t == near ? 0 : 1, attributes);
}

[shader("closesthit")]
void Hit(inout Payload payload, Attributes attributes) {
  payload.t = RayTCurrent();
  payload.normal = normalize(mul((float3x3)ObjectToWorld3x4(), attributes.normal));
}

[shader("miss")]
void Miss(inout Payload payload) {
  payload.t = -1;
}

ProceduralPrimitiveHitGroup Ball = {"", "Hit", "Sphere"};

Payload trace(float3 origin, float3 direction) {
  RayDesc ray = {origin, 0, direction, 100};
  Payload payload = {0, float3(0, 0, 0)};
  TraceRay(TestScene, 0, 0xFF, 0, 0, 0, ray, payload);
  return payload;
}

[test("raygeneration")]
void IsHitInFront() {
  const Payload payload = trace(float3(0, 0, 0), float3(0, 0, 1));
  EXPECT_NEAR(payload.t, 4, 1e-5);
  EXPECT_NEAR(payload.normal, float3(0, 0, -1), 1e-5);
}

[test("raygeneration")]
void IsLeftFromInside() {
  const Payload payload = trace(float3(0, 0, 5), float3(0, 1, 0));
  EXPECT_NEAR(payload.t, 1, 1e-5);
  EXPECT_NEAR(payload.normal, float3(0, 1, 0), 1e-5);
}

// t counts in lengths of the direction, in the world as in the object.
[test("raygeneration")]
[cases(0.5, 1, 2, 10)]
void DistanceIsInDirections(float scale) {
  EXPECT_NEAR(trace(float3(20, 0, 0), float3(0, 0, scale)).t, 2 / scale, 1e-5);
}

// Its box is hit, and it is not.
[test("raygeneration")]
void CornersOfItsBoxAreEmpty() {
  EXPECT_EQ(trace(float3(0.9, 0.9, 0), float3(0, 0, 1)).t, -1);
}
