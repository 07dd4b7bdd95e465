// SPDX-License-Identifier: MIT
// Mirrors that see each other: closest-hit shaders trace further rays. A callable shader, chosen by
// a number in the hit group's record, says what a surface looks like.

RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<float4> image : register(u0);

struct SurfaceIndex {
  uint callable;
};
ConstantBuffer<SurfaceIndex> surface_index : register(b0, space1);  // local: each record has one

static const uint kMaxDepth = 6;  // RayGen's ray is depth 1

struct Payload {
  float3 color;
  uint depth;
};

// In: the place. Out: the surface there.
struct Surface {
  float3 position;
  float3 albedo;
  float mirror;
};

float3 sky(float3 direction) {
  return lerp(float3(1.0, 0.93, 0.82), float3(0.3, 0.5, 0.85), saturate(direction.y * 0.8 + 0.3));
}

[shader("raygeneration")]
void RayGen() {
  const uint2 pixel = DispatchRaysIndex().xy;
  const float2 size = float2(DispatchRaysDimensions().xy);
  const float2 uv = (float2(pixel) + 0.5) / size * 2.0 - 1.0;
  RayDesc ray;
  ray.Origin = float3(0.53, 1.71, -5.5);
  ray.Direction = normalize(float3(uv.x * size.x / size.y, -uv.y - 0.3, 2.0));
  ray.TMin = 0.0;
  ray.TMax = 1000.0;
  Payload payload;
  payload.color = float3(0, 0, 0);
  payload.depth = 1;
  TraceRay(scene, RAY_FLAG_CULL_BACK_FACING_TRIANGLES, 0xFF, 0, 1, 0, ray, payload);
  image[pixel] = float4(pow(saturate(payload.color), 1.0 / 2.2), 1.0);
}

[shader("miss")]
void Miss(inout Payload payload) {
  payload.color = sky(WorldRayDirection());
}

// The normal of the face of an axis-aligned box that was hit.
float3 box_normal(uint primitive, float3 direction) {
  const uint axis = primitive / 4;
  float3 normal = float3(0, 0, 0);
  normal[axis] = 1.0;
  return dot(normal, direction) > 0.0 ? -normal : normal;
}

[shader("closesthit")]
void BoxClosestHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const float3 direction = WorldRayDirection();
  const float3 position = WorldRayOrigin() + RayTCurrent() * direction;
  const float3 normal = box_normal(PrimitiveIndex(), direction);

  Surface surface;
  surface.position = position;
  surface.albedo = float3(0, 0, 0);
  surface.mirror = 0.0;
  CallShader(surface_index.callable, surface);

  const float light = 0.3 + 0.7 * saturate(dot(normal, normalize(float3(-0.5, 0.9, -0.6))));
  float3 color = surface.albedo * light;
  if (surface.mirror > 0.0 && payload.depth < kMaxDepth) {
    RayDesc ray;
    ray.Origin = position + normal * 1e-3;
    ray.Direction = reflect(direction, normal);
    ray.TMin = 0.0;
    ray.TMax = 1000.0;
    Payload reflected;
    reflected.color = float3(0, 0, 0);
    reflected.depth = payload.depth + 1;
    TraceRay(scene, RAY_FLAG_CULL_BACK_FACING_TRIANGLES, 0xFF, 0, 1, 0, ray, reflected);
    color = lerp(color, reflected.color, surface.mirror);
  }
  payload.color = color;
}

[shader("callable")]
void Chequers(inout Surface surface) {
  const float2 tile = floor(surface.position.xz);
  surface.albedo = abs(tile.x + tile.y) % 2.0 == 0.0 ? float3(0.8, 0.8, 0.8) : float3(0.15, 0.17, 0.2);
  surface.mirror = 0.15;
}

[shader("callable")]
void Mirror(inout Surface surface) {
  surface.albedo = float3(0.2, 0.2, 0.22);
  surface.mirror = 0.9;
}

[shader("callable")]
void Stripes(inout Surface surface) {
  surface.albedo = frac(surface.position.y * 3.0) < 0.5 ? float3(0.85, 0.3, 0.12) : float3(0.95, 0.85, 0.6);
  surface.mirror = 0.0;
}
