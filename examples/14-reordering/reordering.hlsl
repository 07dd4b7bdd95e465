// SPDX-License-Identifier: MIT
// What a ray meets and how that is shaded are two calls, between which threads may be reordered.

RaytracingAccelerationStructure scene : register(t0);
StructuredBuffer<float3> box_colors : register(t1);  // by instance
RWTexture2D<float4> image : register(u0);

static const float3 kEye = float3(0, 3.4, -8);
static const float kFocalLength = 1.9, kPitch = 0.27;
static const float3 kToSun = normalize(float3(-0.55, 0.75, -0.45));
static const uint kMostRays = 4;  // of a pixel

// What the shader of a material says about the point that was hit, or the miss shader about the sky.
struct [raypayload] Shading {
  float3 light : write(closesthit, miss) : read(caller);    // that it sends to the eye at any time
  float3 sunlight : write(closesthit, miss) : read(caller);  // what the sun adds, if it is seen
  float3 mirrored : write(closesthit, miss) : read(caller);  // the share of what it mirrors
  float3 normal : write(closesthit, miss) : read(caller);
};

float3 eye_direction(uint2 pixel) {
  const float2 size = float2(DispatchRaysDimensions().xy);
  const float2 p = (2 * (float2(pixel) + 0.5) - size) / size.y / kFocalLength;
  return normalize(float3(p.x, -cos(kPitch) * p.y - sin(kPitch), cos(kPitch) - sin(kPitch) * p.y));
}

bool sees_sun(float3 position) {
  Shading unused = (Shading)0;
  RayDesc to_sun = {position, 0, kToSun, 100};
  const dx::HitObject blocker = dx::HitObject::TraceRay(
      scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH, 0xff, 0, 0, 0, to_sun, unused);
  return blocker.IsMiss();
}

[shader("raygeneration")]
void FollowMirrors() {
  const uint2 pixel = DispatchRaysIndex().xy;
  RayDesc ray = {kEye, 0, eye_direction(pixel), 100};
  float3 color = 0, share = 1;
  for (uint rays = 1; rays <= kMostRays; ++rays) {
    Shading shading = (Shading)0;
    const dx::HitObject hit =
        dx::HitObject::TraceRay(scene, RAY_FLAG_NONE, 0xff, 0, 0, 0, ray, shading);
    // First by the shader that Invoke will run, then by how many rays are left.
    dx::MaybeReorderThread(hit, kMostRays - rays, 2);
    dx::HitObject::Invoke(hit, shading);

    color += share * shading.light;
    if (hit.IsMiss()) break;
    const float3 position =
        ray.Origin + hit.GetRayTCurrent() * ray.Direction + 1e-3 * shading.normal;
    if (any(shading.sunlight > 0) && sees_sun(position)) color += share * shading.sunlight;
    share *= shading.mirrored;
    if (!any(share > 0)) break;
    ray.Origin = position;
    ray.Direction = reflect(ray.Direction, shading.normal);
  }
  image[pixel] = float4(color, 1);
}

[shader("miss")]
void Sky(inout Shading shading) {
  shading = (Shading)0;
  shading.light =
      lerp(float3(0.8, 0.88, 0.95), float3(0.3, 0.5, 0.8), saturate(2 * WorldRayDirection().y));
}

// The side of a cube that was hit, of two triangles; sides in the order of the indices.
float3 side_normal() {
  static const float3 kSides[6] = {float3(0, 0, -1), float3(1, 0, 0), float3(0, 0, 1),
                                   float3(-1, 0, 0), float3(0, 1, 0), float3(0, -1, 0)};
  return normalize(mul(kSides[PrimitiveIndex() / 2], (float3x3)WorldToObject3x4()));
}

Shading matte(float3 color, float3 normal) {
  Shading shading = (Shading)0;
  shading.light = color * (0.3 + 0.1 * normal.y);
  shading.sunlight = color * 0.7 * saturate(dot(normal, kToSun));
  shading.normal = normal;
  return shading;
}

[shader("closesthit")]
void Matte(inout Shading shading, BuiltInTriangleIntersectionAttributes attributes) {
  shading = matte(box_colors[InstanceIndex()], side_normal());
}

[shader("closesthit")]
void Checkered(inout Shading shading, BuiltInTriangleIntersectionAttributes attributes) {
  const float3 position = WorldRayOrigin() + RayTCurrent() * WorldRayDirection();
  const int2 field = int2(floor(position.xz));
  const float3 color = box_colors[InstanceIndex()];
  shading = matte(((field.x + field.y) & 1) == 0 ? color : 0.35 * color, side_normal());
}

[shader("closesthit")]
void Mirror(inout Shading shading, BuiltInTriangleIntersectionAttributes attributes) {
  shading = (Shading)0;
  shading.mirrored = box_colors[InstanceIndex()];
  shading.normal = side_normal();
}
