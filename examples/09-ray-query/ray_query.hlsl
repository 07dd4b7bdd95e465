// SPDX-License-Identifier: MIT
// Ray tracing without a ray tracing pipeline: a compute shader traces rays itself.

RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<float4> image : register(u0);
cbuffer Constants : register(b0) {
  uint2 size;
};

static const uint kGround = 0, kFence = 1, kSpheres = 2;  // InstanceID
static const float3 kSun = normalize(float3(-0.5, 0.9, -0.55));

// Slats; the spaces between them are gaps.
bool is_slat(float3 p) {
  return frac(p.x * 2.5) < 0.55 || frac(p.y * 0.8) < 0.15;
}

// The unit sphere in its box, in object space. t is the same as in world space; negative: no hit.
float hit_sphere(float3 origin, float3 direction) {
  const float a = dot(direction, direction);
  const float b = dot(origin, direction);
  const float discriminant = b * b - a * (dot(origin, origin) - 1);
  return discriminant < 0 ? -1 : (-b - sqrt(discriminant)) / a;
}

// This loop decides what hit groups decide in a pipeline.
void search(RayQuery<RAY_FLAG_NONE> query) {
  while (query.Proceed()) {
    if (query.CandidateType() == CANDIDATE_PROCEDURAL_PRIMITIVE) {
      const float t = hit_sphere(query.CandidateObjectRayOrigin(), query.CandidateObjectRayDirection());
      if (t > query.RayTMin() && t < query.CommittedRayT()) {
        query.CommitProceduralPrimitiveHit(t);
      }
    } else {
      const float3 p =
          query.WorldRayOrigin() + query.CandidateTriangleRayT() * query.WorldRayDirection();
      if (is_slat(p)) {
        query.CommitNonOpaqueTriangleHit();
      }
    }
  }
}

float sunlight(float3 position, float3 normal) {
  RayDesc ray = {position + 0.002 * normal, 0, kSun, 100};
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH, 0xff, ray);
  search(query);
  return query.CommittedStatus() == COMMITTED_NOTHING ? saturate(dot(normal, kSun)) : 0;
}

float3 color_of(uint id, uint primitive, float3 p) {
  if (id == kFence) return float3(0.75, 0.45, 0.2);
  if (id == kSpheres) return lerp(float3(0.9, 0.25, 0.2), float3(0.2, 0.5, 0.9), primitive / 4.0);
  const uint2 tile = uint2(int2(floor(p.xz)));
  return ((tile.x + tile.y) & 1) != 0 ? float3(0.55, 0.6, 0.5) : float3(0.75, 0.78, 0.7);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void Main(uint3 id : SV_DispatchThreadID) {
  if (any(id.xy >= size)) {
    return;
  }
  const float2 p = (float2(id.xy) + 0.5 - 0.5 * float2(size)) / float(size.y);
  RayDesc ray = {float3(0, 2, -6), 0, normalize(float3(p.x, -p.y - 0.2, 0.9)), 100};
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, ray);
  search(query);

  float3 color = lerp(float3(0.75, 0.85, 0.95), float3(0.3, 0.5, 0.8), saturate(ray.Direction.y));
  if (query.CommittedStatus() != COMMITTED_NOTHING) {
    const float3 position = ray.Origin + query.CommittedRayT() * ray.Direction;
    float3 normal = query.CommittedInstanceID() == kGround ? float3(0, 1, 0) : float3(0, 0, -1);
    if (query.CommittedStatus() == COMMITTED_PROCEDURAL_PRIMITIVE_HIT) {
      normal = normalize(query.CommittedObjectRayOrigin() +
                         query.CommittedRayT() * query.CommittedObjectRayDirection());
    }
    color = color_of(query.CommittedInstanceID(), query.CommittedInstanceIndex() - kSpheres, position);
    color *= 0.3 + 0.7 * sunlight(position, normal);
  }
  image[id.xy] = float4(color, 1);
}
