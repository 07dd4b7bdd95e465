// SPDX-License-Identifier: MIT
// One ray, and all that DXR says about its hit. Layouts are those of rays.h and hits.h.

struct Ray {
  float3 origin;
  float t_min;
  float3 direction;
  float t_max;
  uint flags;
  uint mask;
};

struct Hit {
  uint hit;
  uint instance_index;
  uint instance_id;
  uint primitive;
  uint geometry;
  uint kind;
  uint record;
  uint flags;
  float t;
  float2 barycentrics;
  float cosine;
  float3 object_point;
  float3 surface_point;
  float coordinate;
};

struct Attributes {
  float2 place;
};

RaytracingAccelerationStructure g_scene : register(t0);
StructuredBuffer<Ray> g_rays : register(t1);
RWStructuredBuffer<Hit> g_hits : register(u0);

// Root constants in the hit record.
struct RecordConstants {
  uint record;
  uint index_bytes;
};
ByteAddressBuffer l_vertices : register(t0, space1);
ByteAddressBuffer l_indices : register(t1, space1);
ConstantBuffer<RecordConstants> l_record : register(b0, space1);

static const uint kVertexBytes = 48;
static const uint kRayTypes = 2;

[shader("raygeneration")]
void Probe() {
  const uint index = DispatchRaysIndex().y * DispatchRaysDimensions().x + DispatchRaysIndex().x;
  const Ray ray = g_rays[index];
  RayDesc desc;
  desc.Origin = ray.origin;
  desc.TMin = ray.t_min;
  desc.Direction = ray.direction;
  desc.TMax = ray.t_max;
  Hit payload = (Hit)0;
  payload.flags = 0xFFFFFFFF;  // neither shader ran
  TraceRay(g_scene, ray.flags, ray.mask, 0, kRayTypes, 0, desc, payload);
  g_hits[index] = payload;
}

[shader("miss")]
void ProbeMiss(inout Hit payload) {
  payload.flags = RayFlags();
}

// Rejects half of the triangles by their numbers, so that every backend rejects the same ones.
[shader("anyhit")]
void ProbeAnyHit(inout Hit payload, BuiltInTriangleIntersectionAttributes attributes) {
  uint h = (PrimitiveIndex() * 0x9E3779B9u) ^ (InstanceIndex() * 0x85EBCA6Bu);
  h ^= h >> 15;
  if ((h & 1) != 0) IgnoreHit();
}

uint Corner(uint i) {
  if (l_record.index_bytes == 4) return l_indices.Load(i * 4);
  const uint word = l_indices.Load((i >> 1) * 4);
  return (i & 1) != 0 ? word >> 16 : word & 0xFFFF;
}

// The largest coordinate that the hit was computed from.
float LargestCoordinate() {
  const float3 hit = WorldRayOrigin() + RayTCurrent() * WorldRayDirection();
  const float3 far = max(abs(WorldRayOrigin()), abs(hit));
  return max(far.x, max(far.y, far.z));
}

float3 Position(uint corner) {
  return asfloat(l_vertices.Load3(corner * kVertexBytes));
}

[shader("closesthit")]
void ProbeHit(inout Hit payload, BuiltInTriangleIntersectionAttributes attributes) {
  const uint first = PrimitiveIndex() * 3;
  const float3 a = Position(Corner(first));
  const float3 ab = Position(Corner(first + 1)) - a;
  const float3 ac = Position(Corner(first + 2)) - a;
  const float3 across = cross(ab, ac);
  const float3 normal = mul(across, (float3x3)WorldToObject3x4());
  const float3 direction = WorldRayDirection();
  payload.hit = 1;
  payload.instance_index = InstanceIndex();
  payload.instance_id = InstanceID();
  payload.primitive = PrimitiveIndex();
  payload.geometry = GeometryIndex();
  payload.kind = HitKind();
  payload.record = l_record.record;
  payload.flags = RayFlags();
  payload.t = RayTCurrent();
  payload.barycentrics = attributes.barycentrics;
  payload.cosine = abs(dot(normalize(normal), normalize(direction)));
  const float3 world = WorldRayOrigin() + RayTCurrent() * direction;
  payload.object_point = mul(WorldToObject3x4(), float4(world, 1.0f));
  const float2 b = attributes.barycentrics;
  payload.surface_point = mul(ObjectToWorld3x4(), float4(a + b.x * ab + b.y * ac, 1.0f));
  payload.coordinate = LargestCoordinate();
}

// Each box is filled by a ball.
[shader("intersection")]
void ProbeBall() {
  const float3 direction = ObjectRayDirection();
  const float a = dot(direction, direction);
  const float b = dot(ObjectRayOrigin(), direction);
  const float c = dot(ObjectRayOrigin(), ObjectRayOrigin()) - 1.0f;
  const float inside = b * b - a * c;
  if (inside < 0.0f) return;
  Attributes attributes;
  const float root = sqrt(inside);
  attributes.place = float2(a, b);
  if (!ReportHit((-b - root) / a, 1, attributes)) {
    attributes.place = float2(b, a);
    ReportHit((-b + root) / a, 2, attributes);
  }
}

[shader("closesthit")]
void ProbeBallHit(inout Hit payload, Attributes attributes) {
  const float3 world = WorldRayOrigin() + RayTCurrent() * WorldRayDirection();
  payload.hit = 1;
  payload.instance_index = InstanceIndex();
  payload.instance_id = InstanceID();
  payload.primitive = PrimitiveIndex();
  payload.geometry = GeometryIndex();
  payload.kind = HitKind();
  payload.record = l_record.record;
  payload.flags = RayFlags();
  payload.t = RayTCurrent();
  payload.barycentrics = attributes.place;
  payload.object_point = mul(WorldToObject3x4(), float4(world, 1.0f));
  payload.cosine = abs(dot(payload.object_point, normalize(ObjectRayDirection())));
  payload.surface_point = world;
  payload.coordinate = LargestCoordinate();
}
