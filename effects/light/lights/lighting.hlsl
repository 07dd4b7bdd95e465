// SPDX-License-Identifier: MIT
// Prepares what hit_lighting.hlsli reads: the lists of lights per cluster, and the lights' shadow
// maps, which rays from the lights render from the same top level that all other rays see.
#include "alpha_test.hlsli"
#include "hit_lighting.hlsli"
#include "light_reach.hlsli"

// Squared distance from a box to a point; 0 inside.
float DistanceSquared(float3 low, float3 high, float3 p) {
  const float3 d = max(max(low - p, p - high), float3(0, 0, 0));
  return dot(d, d);
}

// Tells whether a sphere lies beside a spot's cone, that is, whether its centre is further from the
// cone's side than its radius. `tip` and `axis` are in the sphere's space. NaN counts as not
// beside.
bool IsBesideCone(float3 tip, float3 axis, float cosine, float3 center, float radius) {
  const float3 d = center - tip;
  const float along = dot(d, axis);
  const float across = sqrt(max(dot(d, d) - along * along, 0.0));
  const float sine = sqrt(1.0 - cosine * cosine);
  return across * cosine - along * sine > radius + 1e-3 * length(d);  // a margin for rounding
}

// One thread per cluster: id.x is the cell's x, id.y holds y and z. Lights are listed in ascending
// order, so that a sum over a cluster adds in the same order as a sum over all lights.
[shader("compute")]
[numthreads(8, 8, 1)]
void BuildClusters(uint3 id : SV_DispatchThreadID) {
  const uint cluster = id.y * kClusterCells + id.x;
  const int3 cell = int3(id.x, id.y % kClusterCells, id.y / kClusterCells);
  const float3 low = float3(ClusterLow(cell.x), ClusterLow(cell.y), ClusterLow(cell.z));
  const float3 high = float3(ClusterHigh(cell.x), ClusterHigh(cell.y), ClusterHigh(cell.z));
  uint count = 0;
  for (uint i = 0; i < frame.light_count; ++i) {
    const LightConstants light = lights[i];
    const Sphere reach = SafeReachOf(light);
    if (DistanceSquared(low, high, ClusterSpace(reach.center)) > reach.radius * reach.radius) {
      continue;
    }
    if (light.is_spot != 0 && light.cos_outer > kWidestMap &&
        IsBesideCone(ClusterSpace(light.position), ClusterSpace(light.direction), light.cos_outer,
                     0.5 * (low + high), 0.5 * length(high - low))) {
      continue;
    }
    if (count < kClusterCapacity) cluster_lights[cluster * kClusterCapacity + count] = i;
    ++count;
  }
  cluster_counts[cluster] = count > kClusterCapacity ? kClusterOverflow : count;
}

struct OccluderPayload {
  float4 occluder;  // in the format of shadow_atlas
};

// Below this cosine, the plane is replaced by one that faces the light: seen so obliquely, a texel
// no longer tells where the plane is.
static const float kLeastCosine = 0.02;

[shader("miss")]
void ShadowAtlasMiss(inout OccluderPayload payload) {
  payload.occluder = float4(0, 0, 0, 0);
}

[shader("anyhit")]
void ShadowAtlasAnyHit(inout OccluderPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

[shader("closesthit")]
void ShadowAtlasClosestHit(inout OccluderPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const uint3 corners = LoadTriangle(indices, hit_constants.index_size_bytes, PrimitiveIndex());
  const float3 normal =
      MakeSpawnPoint(LoadVertexFloat3(vertices, hit_constants.vertex_stride, 0, corners.x),
                     LoadVertexFloat3(vertices, hit_constants.vertex_stride, 0, corners.y),
                     LoadVertexFloat3(vertices, hit_constants.vertex_stride, 0, corners.z),
                     hit.barycentrics, ObjectToWorld3x4(), WorldToObject3x4()).normal;
  const float3 direction = WorldRayDirection();
  const float cosine = dot(normal, direction);
  const bool faces = abs(cosine) > kLeastCosine;
  payload.occluder = float4(faces ? normal / cosine : direction, 1.0) / RayTCurrent();
}

[shader("raygeneration")]
void ShadowAtlasRayGen() {
  const uint2 texel = uint2(DispatchRaysIndex().x, DispatchRaysIndex().y + pass_constants.first_row);
  const uint id = texel.y / kShadowTile * kShadowTilesPerRow + texel.x / kShadowTile;
  if (id >= frame.light_count) return;
  const LightConstants light = lights[id];
  const float2 uv = (float2(texel % kShadowTile) + 0.5) / float(kShadowTile);
  RayDesc ray;
  ray.Origin = light.position;
  ray.Direction = ShadowMapDirection(light, uv);
  // Whatever lies inside the light's own sphere belongs to the lamp.
  ray.TMin = min(light.radius, light.range);
  ray.TMax = light.range;
  OccluderPayload payload;
  payload.occluder = float4(0, 0, 0, 0);
  TraceRay(scene, RAY_FLAG_NONE, kMaskWithoutLamps, kRayTypeSurface, kRayTypeCount, kRayTypeSurface,
           ray, payload);
  shadow_atlas[texel] = payload.occluder;
}

// The sun's map: parallel rays from where nothing can lie in front of them.
[shader("closesthit")]
void SunMapClosestHit(inout OccluderPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const uint3 corners = LoadTriangle(indices, hit_constants.index_size_bytes, PrimitiveIndex());
  const float3 normal =
      MakeSpawnPoint(LoadVertexFloat3(vertices, hit_constants.vertex_stride, 0, corners.x),
                     LoadVertexFloat3(vertices, hit_constants.vertex_stride, 0, corners.y),
                     LoadVertexFloat3(vertices, hit_constants.vertex_stride, 0, corners.z),
                     hit.barycentrics, ObjectToWorld3x4(), WorldToObject3x4()).normal;
  const float3 direction = WorldRayDirection();
  const float cosine = dot(normal, direction);
  float2 slope = float2(0, 0);
  if (abs(cosine) > kLeastCosine) {
    // map_right and map_up are shorter than unit by half the side, which 2 / size of them are.
    const float step = frame.sun_map_texel * 0.5 * float(frame.sun_map_size) * frame.sun_map_texel;
    slope = float2(dot(normal, frame.sun_map_right), dot(normal, frame.sun_map_up)) *
            (-step / cosine);
  }
  payload.occluder = float4(RayTCurrent() - frame.sun_map_reach, slope, 1.0);
}

[shader("raygeneration")]
void SunMapRayGen() {
  const uint2 texel = uint2(DispatchRaysIndex().x, DispatchRaysIndex().y + pass_constants.first_row);
  if (max(texel.x, texel.y) >= frame.sun_map_size) return;
  const float half_side = 0.5 * frame.sun_map_texel * float(frame.sun_map_size);
  const float2 at = ((float2(texel) + 0.5) / float(frame.sun_map_size) * 2.0 - 1.0) *
                    (half_side * half_side);
  RayDesc ray;
  ray.Direction = -frame.direction_to_sun;
  ray.Origin = frame.sun_map_centre + frame.sun_map_right * at.x + frame.sun_map_up * at.y -
               ray.Direction * frame.sun_map_reach;
  ray.TMin = 0.0;
  ray.TMax = 2.0 * frame.sun_map_reach;
  OccluderPayload payload;
  payload.occluder = float4(0, 0, 0, 0);
  TraceRay(scene, RAY_FLAG_NONE, kMaskWithoutLamps, kRayTypeSurface, kRayTypeCount, kRayTypeSurface,
           ray, payload);
  shadow_atlas[SunMapOrigin() + texel] = payload.occluder;
}
