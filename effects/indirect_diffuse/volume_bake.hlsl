// SPDX-License-Identifier: MIT
// Fills the volume by path tracing: rays from the centre of each cell in all directions, and on
// from their hits. [effects-spec B5.1]
#include "hit_lighting.hlsli"
#include "indirect_volume.hlsli"
#include "sampling.hlsli"
#include "surface.hlsli"
#include "visibility.hlsli"

// Sums over samples. Radiance from a unit direction d is mean + slope_x d.x + slope_y d.y + slope_z
// d.z. effects/indirect_diffuse/volume.h has the same layout.
struct CellSums {
  float3 mean;
  float validity;  // samples whose ray hit a back face
  float3 slope_x;
  float padding0;
  float3 slope_y;
  float padding1;
  float3 slope_z;
  float padding2;
};

RWStructuredBuffer<CellSums> sums : register(u0, space3);
StructuredBuffer<float4> cell_centers : register(t3, space3);  // relative to the camera

struct BakeConstants {
  uint cell_count;
  uint first_sample;
  uint sample_count;
  uint bounces;  // after the first hit
  uint width;    // of the dispatch
  uint seed;
};
ConstantBuffer<BakeConstants> constants : register(b0, space3);

// What a path needs to know about a hit to continue.
struct PathPayload {
  float3 position;
  float offset;  // negative: a miss
  float3 normal;
  uint back_face;
  float3 albedo;
  float padding;
  float3 emissive;
};

[shader("miss")]
void PathMiss(inout PathPayload payload) {
  payload.offset = -1.0;
}

[shader("anyhit")]
void PathAnyHit(inout PathPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

[shader("closesthit")]
void PathClosestHit(inout PathPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const Surface surface = LoadSurface(hit.barycentrics, 0.0);
  payload.position = surface.position;
  payload.offset = surface.offset;
  payload.normal = surface.normal;
  payload.back_face = surface.back_face ? 1 : 0;
  // Metal reflects light too; in this diffuse volume, in all directions alike.
  payload.albedo = surface.base_color * lerp(1.0, 0.7, surface.metallic);
  payload.emissive = surface.emissive;
}

// A local light that was chosen, and its unshadowed irradiance on a surface.
struct ChosenLight {
  float3 irradiance;  // estimates that of all lights
  float3 direction;
  float reach;  // distance to the lamp's surface, metres
};

// Picks one of all lights with a probability proportional to its brightness here, because a shadow
// ray to each would cost too much. Weighted reservoir sampling in one pass; `u` in 0..1 is rescaled
// after each light, so a single random number is enough. [resampling, Talbot et al. 2005]
ChosenLight ChooseLight(float3 position, float3 normal, float u) {
  ChosenLight chosen;
  chosen.irradiance = chosen.direction = float3(0, 0, 0);
  chosen.reach = 0.0;
  float total = 0.0;
  float of_chosen = 1.0;
  const ClusterRange range = ClusterLights(position);
  for (uint i = 0; i < range.count; ++i) {
    const LightConstants light = lights[ClusterLight(range, i)];
    const LightSample s = SampleLight(light, position);
    const float3 irradiance = s.irradiance * max(dot(normal, s.direction), 0.0);
    const float luminance = RadianceLuminance(irradiance);
    if (!(luminance > 0.0)) continue;
    total += luminance;
    const float share = luminance / total;
    if (u < share) {
      u = u / share;
      of_chosen = luminance;
      chosen.irradiance = irradiance;
      chosen.direction = s.direction;
      chosen.reach = s.distance - light.radius;
    } else {
      u = (u - share) / (1.0 - share);
    }
  }
  chosen.irradiance *= total / of_chosen;
  return chosen;
}

// Irradiance / pi of the sun and the local lights on a surface, with shadow rays.
float3 DirectAt(PathPayload hit, float u) {
  const float3 origin = hit.position + hit.normal * hit.offset;
  float3 sum = float3(0, 0, 0);
  const float toward_sun = dot(hit.normal, frame.direction_to_sun);
  if (toward_sun > 0.0 && any(frame.sun_irradiance > 0.0)) {
    sum += frame.sun_irradiance *
           (toward_sun * TraceVisibility(origin, frame.direction_to_sun, kSunDistance));
  }
  const ChosenLight light = ChooseLight(hit.position, hit.normal, u);
  if (any(light.irradiance > 0.0)) {
    sum += light.irradiance *
           (light.reach > 0.0 ? TraceVisibility(origin, light.direction, light.reach) : 1.0);
  }
  return sum / kBrdfPi;
}

PathPayload TracePath(float3 origin, float3 direction) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0.0;
  ray.Direction = direction;
  ray.TMax = 1e30;
  PathPayload payload;
  payload.position = payload.normal = payload.albedo = payload.emissive = float3(0, 0, 0);
  payload.offset = -1.0;
  payload.back_face = 0;
  payload.padding = 0.0;
  TraceRay(scene, RAY_FLAG_NONE, kMaskWithoutLamps, kRayTypeSurface, kRayTypeCount,
           kRayTypeSurface, ray, payload);
  return payload;
}

float2 Random2(uint key) { return float2(UnitFloat(PcgHash(key)), UnitFloat(PcgHash(key ^ 0x9E3779B9u))); }

// Radiance along a ray. `back_face` tells whether the first hit was the back of a surface.
float3 PathRadiance(float3 origin, float3 direction, uint key, out bool back_face) {
  float3 radiance = float3(0, 0, 0);
  float3 throughput = float3(1, 1, 1);
  back_face = false;
  for (uint bounce = 0; bounce <= constants.bounces; ++bounce) {
    const PathPayload hit = TracePath(origin, direction);
    if (hit.offset < 0.0) {
      radiance += throughput * SkyTowards(direction);
      break;
    }
    if (bounce == 0) back_face = hit.back_face != 0;
    const float u = UnitFloat(PcgHash(HashCombine(key, ~bounce)));
    radiance += throughput * (hit.emissive + hit.albedo * DirectAt(hit, u));
    throughput *= hit.albedo;
    origin = hit.position + hit.normal * hit.offset;
    direction = ToWorld(SampleCosineHemisphere(Random2(HashCombine(key, bounce + 1))), hit.normal);
  }
  return radiance;
}

[shader("raygeneration")]
void BakeRayGen() {
  const uint cell = DispatchRaysIndex().y * constants.width + DispatchRaysIndex().x;
  if (cell >= constants.cell_count) return;
  CellSums sum = sums[cell];
  const float3 center = cell_centers[cell].xyz;
  const uint cell_seed = HashCombine(constants.seed, cell);
  for (uint i = 0; i < constants.sample_count; ++i) {
    const uint index = constants.first_sample + i;
    // Uniform over the sphere.
    const float2 u = SobolOwen(index, cell_seed);
    const float z = 1.0 - 2.0 * u.x;
    const float r = sqrt(max(0.0, 1.0 - z * z));
    const float3 direction = float3(r * cos(6.2831853 * u.y), r * sin(6.2831853 * u.y), z);
    bool back_face;
    const float3 radiance = PathRadiance(center, direction, HashCombine(cell_seed, index), back_face);
    sum.mean += radiance;
    sum.slope_x += 3.0 * radiance * direction.x;
    sum.slope_y += 3.0 * radiance * direction.y;
    sum.slope_z += 3.0 * radiance * direction.z;
    sum.validity += back_face ? 1.0 : 0.0;
  }
  sums[cell] = sum;
}
