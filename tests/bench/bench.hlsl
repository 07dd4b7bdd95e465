// SPDX-License-Identifier: MIT
// The shaders of dispatch/...: the least that a program can do with a ray, and two that do a little
// more (an alpha test, a textured hit). Layouts are those of scene_data.h and embree_loops.h.

struct Ray {
  float3 origin;
  float t_min;
  float3 direction;
  float t_max;
};

struct Closest {
  float t;
  uint primitive;
};

struct Shaded {
  float3 color;
  float t;
  float3 normal;
  uint material;
};

struct Visibility {
  uint visible;
};

struct Material {
  float4 base_color;
  float alpha_cutoff;
  int image;
};

struct HitConstants {
  uint material;
};

RaytracingAccelerationStructure g_scene : register(t0);
StructuredBuffer<Ray> g_rays : register(t1);
StructuredBuffer<Material> g_materials : register(t2);
Texture2D<float4> g_images[] : register(t0, space1);
SamplerState g_sampler : register(s0);
RWStructuredBuffer<Closest> g_closest : register(u0);
RWStructuredBuffer<uint> g_visible : register(u1);
RWStructuredBuffer<Shaded> g_shaded : register(u2);

// The hit record's local arguments.
ByteAddressBuffer l_vertices : register(t0, space2);
ByteAddressBuffer l_indices : register(t1, space2);
ConstantBuffer<HitConstants> l_hit : register(b0, space2);

static const uint kVertexBytes = 48;
static const uint kNormalOffset = 12;
static const uint kUvOffset = 40;

uint RayIndex() { return DispatchRaysIndex().y * DispatchRaysDimensions().x + DispatchRaysIndex().x; }

RayDesc LoadRay(uint index) {
  const Ray ray = g_rays[index];
  RayDesc desc;
  desc.Origin = ray.origin;
  desc.TMin = ray.t_min;
  desc.Direction = ray.direction;
  desc.TMax = ray.t_max;
  return desc;
}

[shader("raygeneration")]
void ClosestRays() {
  const uint index = RayIndex();
  Closest payload = {-1.0f, 0xFFFFFFFFu};
  TraceRay(g_scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0, LoadRay(index), payload);
  g_closest[index] = payload;
}

[shader("closesthit")]
void ClosestHit(inout Closest payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.t = RayTCurrent();
  payload.primitive = PrimitiveIndex();
}

[shader("miss")]
void ClosestMiss(inout Closest payload) {}

[shader("raygeneration")]
void VisibilityRays() {
  const uint index = RayIndex();
  Visibility payload = {0};
  TraceRay(g_scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER,
           0xFF, 0, 1, 0, LoadRay(index), payload);
  g_visible[index] = payload.visible;
}

[shader("miss")]
void VisibilityMiss(inout Visibility payload) { payload.visible = 1; }

uint3 HitTriangle() { return l_indices.Load3(PrimitiveIndex() * 12); }

float2 HitUv(uint3 corners, float2 barycentrics) {
  const float2 a = asfloat(l_vertices.Load2(corners.x * kVertexBytes + kUvOffset));
  const float2 b = asfloat(l_vertices.Load2(corners.y * kVertexBytes + kUvOffset));
  const float2 c = asfloat(l_vertices.Load2(corners.z * kVertexBytes + kUvOffset));
  return a * (1.0f - barycentrics.x - barycentrics.y) + b * barycentrics.x + c * barycentrics.y;
}

float3 HitNormal(uint3 corners, float2 barycentrics) {
  const float3 a = asfloat(l_vertices.Load3(corners.x * kVertexBytes + kNormalOffset));
  const float3 b = asfloat(l_vertices.Load3(corners.y * kVertexBytes + kNormalOffset));
  const float3 c = asfloat(l_vertices.Load3(corners.z * kVertexBytes + kNormalOffset));
  return a * (1.0f - barycentrics.x - barycentrics.y) + b * barycentrics.x + c * barycentrics.y;
}

[shader("anyhit")]
void AlphaTest(inout Visibility payload, BuiltInTriangleIntersectionAttributes attributes) {
  const Material material = g_materials[l_hit.material];
  float alpha = material.base_color.w;
  if (material.image >= 0) {
    const float2 uv = HitUv(HitTriangle(), attributes.barycentrics);
    alpha *= g_images[NonUniformResourceIndex(material.image)].SampleLevel(g_sampler, uv, 0).w;
  }
  if (alpha < material.alpha_cutoff) IgnoreHit();
}

[shader("raygeneration")]
void ShadedRays() {
  const uint index = RayIndex();
  Shaded payload = {float3(0, 0, 0), -1.0f, float3(0, 0, 0), 0xFFFFFFFFu};
  TraceRay(g_scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0, LoadRay(index), payload);
  g_shaded[index] = payload;
}

[shader("closesthit")]
void ShadedHit(inout Shaded payload, BuiltInTriangleIntersectionAttributes attributes) {
  const Material material = g_materials[l_hit.material];
  const uint3 corners = HitTriangle();
  float3 color = material.base_color.xyz;
  if (material.image >= 0) {
    const float2 uv = HitUv(corners, attributes.barycentrics);
    color *= g_images[NonUniformResourceIndex(material.image)].SampleLevel(g_sampler, uv, 0).xyz;
  }
  const float3 local = HitNormal(corners, attributes.barycentrics);
  payload.color = color;
  payload.t = RayTCurrent();
  payload.normal = normalize(mul((float3x3)ObjectToWorld3x4(), local));
  payload.material = l_hit.material;
}

[shader("miss")]
void ShadedMiss(inout Shaded payload) {}
