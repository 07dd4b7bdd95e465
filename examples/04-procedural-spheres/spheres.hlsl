// SPDX-License-Identifier: MIT
// Spheres without triangles: the application provides boxes, and an intersection shader says where
// in a box a ray hits. Rays to the light are a second type, with records of their own.

RaytracingAccelerationStructure scene : register(t0);
StructuredBuffer<float4> spheres : register(t1);  // centre, radius
RWTexture2D<float4> image : register(u0);

static const uint kCameraRay = 0;
static const uint kShadowRay = 1;
static const uint kRayTypes = 2;

struct Payload {
  float3 color;
};
struct ShadowPayload {
  float visibility;
};

// The attributes that an intersection shader passes to the hit shaders: at most 32 bytes.
struct SphereAttributes {
  float3 normal;
};

static const uint kEntering = 0;  // hit kinds 0 to 127 are the application's
static const uint kLeaving = 1;

[shader("raygeneration")]
void RayGen() {
  const uint2 pixel = DispatchRaysIndex().xy;
  const float2 size = float2(DispatchRaysDimensions().xy);
  const float2 uv = (float2(pixel) + 0.5) / size * 2.0 - 1.0;
  RayDesc ray;
  ray.Origin = float3(0, 1, -7);
  ray.Direction = normalize(float3(uv.x * size.x / size.y, -uv.y - 0.15, 2.2));
  ray.TMin = 0.0;
  ray.TMax = 1000.0;
  Payload payload = { float3(0, 0, 0) };
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, kCameraRay, kRayTypes, kCameraRay, ray, payload);
  image[pixel] = float4(payload.color, 1.0);
}

[shader("intersection")]
void SphereIntersection() {
  const float4 sphere = spheres[PrimitiveIndex()];
  const float3 direction = ObjectRayDirection();
  const float3 to_origin = ObjectRayOrigin() - sphere.xyz;
  const float a = dot(direction, direction);
  const float b = dot(to_origin, direction);
  const float c = dot(to_origin, to_origin) - sphere.w * sphere.w;
  const float discriminant = b * b - a * c;
  if (discriminant < 0.0) {
    return;
  }
  const float root = sqrt(discriminant);
  SphereAttributes attributes;
  const float near = (-b - root) / a;
  attributes.normal = (to_origin + near * direction) / sphere.w;
  // False if the hit lies outside (RayTMin, RayTCurrent); then try the far side.
  if (!ReportHit(near, kEntering, attributes)) {
    const float far = (-b + root) / a;
    attributes.normal = -(to_origin + far * direction) / sphere.w;
    ReportHit(far, kLeaving, attributes);
  }
}

// The intersection shader is all that a hit group of shadow rays needs: any hit ends the search.
float visibility_towards(float3 position, float3 direction) {
  RayDesc ray;
  ray.Origin = position;
  ray.Direction = direction;
  ray.TMin = 0.0;
  ray.TMax = 1000.0;
  ShadowPayload payload = { 0.0 };
  TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER, 0xFF,
           kShadowRay, kRayTypes, kShadowRay, ray, payload);
  return payload.visibility;
}

[shader("closesthit")]
void SphereClosestHit(inout Payload payload, in SphereAttributes attributes) {
  const float3 normal = normalize(mul((float3x3)ObjectToWorld3x4(), attributes.normal));
  const float3 to_light = normalize(float3(-0.5, 0.8, -0.6));
  const float3 position = WorldRayOrigin() + RayTCurrent() * WorldRayDirection();
  float light = 0.2;
  if (dot(normal, to_light) > 0.0) {
    light += 0.8 * dot(normal, to_light) * visibility_towards(position + normal * 1e-3, to_light);
  }
  const float3 tint = 0.5 + 0.5 * cos(float(PrimitiveIndex()) * 1.7 + float3(0.0, 2.1, 4.2));
  payload.color = HitKind() == kLeaving ? float3(0, 0, 0) : tint * light;
}

[shader("miss")]
void Miss(inout Payload payload) {
  payload.color = lerp(float3(0.95, 0.95, 0.93), float3(0.6, 0.72, 0.88), saturate(WorldRayDirection().y * 2.0));
}

[shader("miss")]
void ShadowMiss(inout ShadowPayload payload) {
  payload.visibility = 1.0;
}
