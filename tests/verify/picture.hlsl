// SPDX-License-Identifier: MIT
// A floor of two triangles, a tilted triangle and an ellipsoid, seen from `eye`; `light` casts shadows
// onto the floor. Each texel is (t, attributes, code): code is InstanceID + 16 * PrimitiveIndex,
// + 64 where a floor is lit; t is -1 where nothing is seen.

RaytracingAccelerationStructure scene : register(t0);
RWStructuredBuffer<float4> picture : register(u0);
cbuffer Camera : register(b0) {
  float3 eye;
  float3 light;
};
cbuffer Record : register(b0, space1) {
  float radius;
};

struct Payload {
  float4 seen;
};
struct Shadow {
  uint lit;
};
struct Normal {
  float2 xy;
};

static const uint kFloor = 1;

[shader("raygeneration")]
void RayGen() {
  const uint2 pixel = DispatchRaysIndex().xy;
  const uint2 size = DispatchRaysDimensions().xy;
  const float2 uv = (float2(pixel) + 0.5) / float2(size) * 2.0 - 1.0;
  RayDesc ray;
  ray.Origin = eye;
  ray.Direction = float3(1.6 * uv.x, -1.2 * uv.y, 2.0);
  ray.TMin = 0.0;
  ray.TMax = 100.0;
  Payload payload = { float4(0, 0, 0, 0) };
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 0, 0, ray, payload);
  picture[pixel.y * size.x + pixel.x] = payload.seen;
}

[shader("miss")]
void Miss(inout Payload payload) {
  payload.seen = float4(-1, 0, 0, 0);
}

[shader("miss")]
void LightIsSeen(inout Shadow shadow) {
  shadow.lit = 1;
}

float code_of_hit() {
  return float(InstanceID() + 16 * PrimitiveIndex());
}

[shader("closesthit")]
void TriangleHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes attributes) {
  float code = code_of_hit();
  if (InstanceID() == kFloor) {
    RayDesc ray;
    ray.Origin = WorldRayOrigin() + RayTCurrent() * WorldRayDirection();
    ray.Direction = light - ray.Origin;
    ray.TMin = 0.001;
    ray.TMax = 1.0;
    Shadow shadow = { 0 };
    TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER, 0xFF, 0, 0, 1, ray,
             shadow);
    code += 64.0 * float(shadow.lit);
  }
  payload.seen = float4(RayTCurrent(), attributes.barycentrics, code);
}

// A sphere in its object's space; the instance makes an ellipsoid of it.
[shader("intersection")]
void FindSphere() {
  const float3 origin = ObjectRayOrigin();
  const float3 direction = ObjectRayDirection();
  const float a = dot(direction, direction);
  const float b = dot(origin, direction);
  const float discriminant = b * b - a * (dot(origin, origin) - radius * radius);
  if (discriminant < 0.0) {
    return;
  }
  const float t = (-b - sqrt(discriminant)) / a;
  Normal normal = { (origin + t * direction).xy / radius };
  ReportHit(t, 0, normal);
}

[shader("closesthit")]
void SphereHit(inout Payload payload, in Normal normal) {
  payload.seen = float4(RayTCurrent(), normal.xy, code_of_hit());
}
