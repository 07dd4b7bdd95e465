// SPDX-License-Identifier: MIT
// Fills the volume by path tracing: rays from the centre of each cell in all directions, and on
// from their hits until Russian roulette ends them. Nothing that moves is seen. [Northlight deck:
// GI Data in Sparse Volume Texture]
#include "hit_lighting.hlsli"
#include "indirect_volume.hlsli"
#include "sampling.hlsli"
#include "surface_brdf.hlsli"
#include "visibility.hlsli"

// Sums over samples. Radiance from a unit direction d is mean + slope_x d.x + slope_y d.y + slope_z
// d.z. effects/indirect/indirect_diffuse/volume_baker.cpp has the same layouts.
struct CellSums {
  float3 mean;
  float back_faces;  // samples whose ray hit a back face first
  float3 slope_x;
  float luminance_squared;
  float3 slope_y;
  float padding0;
  float3 slope_z;
  float padding1;
};

// Each cell has two sums, of samples that are independent: 2 c and 2 c + 1.
RWStructuredBuffer<CellSums> sums : register(u0, space3);
// By cell, bits: which of the cells around it can be seen from it. [SeeRayGen]
RWStructuredBuffer<uint> seen : register(u1, space3);
StructuredBuffer<float4> cell_centers : register(t3, space3);  // relative to the camera; w: size
// By place in the dispatch: a sum, the samples that it has, and those that it is to have.
StructuredBuffer<uint3> tasks : register(t4, space3);
StructuredBuffer<uint> baked_lights : register(t5, space3);  // 1: by local light, it is baked

struct BakeConstants {
  uint task_count;
  uint done;          // samples that earlier dispatches have added to each sum
  uint sample_count;  // that this one adds at most
  uint bounces;  // at most, after the first hit
  uint width;    // of the dispatch
  uint seed;
  uint lights;  // kBakeSun and so on
};
ConstantBuffer<BakeConstants> constants : register(b0, space3);

// BakedLights in volume.h.
static const uint kBakeSun = 1;
static const uint kBakeSky = 2;
static const uint kBakeLocal = 4;
static const uint kBakeEmissive = 8;

// Instances that stand still and are neither glass nor lamps. [effects/assets/scene/scene.h: InstanceMask]
static const uint kMaskBaked = 0x20;

// The data of a hit that a path needs to continue.
struct PathPayload {
  float3 position;
  float offset;  // negative: a miss
  float3 normal;
  uint back_face;
  SpreadBrdf brdf;
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
  payload.brdf = SurfaceSpreadBrdf(surface, -WorldRayDirection());
  payload.emissive = surface.emissive;
}

float2 Random2(uint key) { return float2(UnitFloat(PcgHash(key)), UnitFloat(PcgHash(key ^ 0x9E3779B9u))); }

// 1 if no instance that is baked lies on the way.
float BakeVisibility(float3 origin, float3 direction, float t_max) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0.0;
  ray.Direction = direction;
  ray.TMax = t_max;
  VisibilityPayload payload;
  payload.visibility = 0.0;
  TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER,
           kMaskBaked, kRayTypeVisibility, kRayTypeCount, kRayTypeVisibility, ray, payload);
  return payload.visibility;
}

// A local light that was chosen, and its unshadowed irradiance on a surface that faces it.
struct ChosenLight {
  float3 irradiance;  // over the probability of the choice
  float3 direction;   // to the centre
  float distance;     // to the centre, metres
  float radius;
};

// Picks one of all lights with a probability proportional to its brightness here, because a shadow
// ray to each would cost too much. Weighted reservoir sampling in one pass; `u` in 0..1 is rescaled
// after each light, so a single random number is enough. [resampling, Talbot et al. 2005]
ChosenLight ChooseLight(float3 position, float3 normal, float u) {
  ChosenLight chosen;
  chosen.irradiance = chosen.direction = float3(0, 0, 0);
  chosen.distance = chosen.radius = 0.0;
  float total = 0.0;
  float of_chosen = 1.0;
  const ClusterRange range = ClusterLights(position);
  for (uint i = 0; i < range.count; ++i) {
    const uint id = ClusterLight(range, i);
    if (baked_lights[id] == 0) continue;
    const LightConstants light = lights[id];
    const LightSample s = SampleLight(light, position);
    // The highest point of a lamp may be above the horizon where its centre is not.
    const float facing = dot(normal, s.direction) + min(light.radius / s.distance, 1.0);
    const float weight = RadianceLuminance(s.irradiance) * facing;
    if (!(weight > 0.0)) continue;
    total += weight;
    const float share = weight / total;
    if (u < share) {
      u = u / share;
      of_chosen = weight;
      chosen.irradiance = s.irradiance;
      chosen.direction = s.direction;
      chosen.distance = s.distance;
      chosen.radius = light.radius;
    } else {
      u = (u - share) / (1.0 - share);
    }
  }
  chosen.irradiance *= total / of_chosen;
  return chosen;
}

// What is reflected, times pi, of a lamp, which is a sphere that shines alike all over, by a ray
// within the cone that it fills: the mean over the cone is irradiance * cosine to the centre where
// nothing hides it.
float3 LampAt(PathPayload hit, float3 origin, ChosenLight light, float2 u) {
  const float3 normal = hit.normal;
  if (light.distance <= light.radius) {
    const float above = max(dot(normal, light.direction), 0.0);
    return light.irradiance * (above * SpreadAlbedo(hit.brdf, above));
  }
  const float sine = light.radius / light.distance;
  const float cosine = sqrt(1.0 - sine * sine);
  // 1 - cosine, without cancellation.
  const float height = sine * sine / (1.0 + cosine);
  const float z = 1.0 - u.x * height;
  const float r = sqrt(max(0.0, 1.0 - z * z));
  const float phi = 6.2831853 * u.y;
  const float3 direction = ToWorld(float3(r * cos(phi), r * sin(phi), z), light.direction);
  const float facing = dot(normal, direction);
  if (!(facing > 0.0)) return float3(0, 0, 0);
  const float aside = light.distance * r;
  const float reach =
      light.distance * z - sqrt(max(0.0, light.radius * light.radius - aside * aside));
  return light.irradiance * SpreadAlbedo(hit.brdf, facing) *
         (facing * 2.0 / (1.0 + cosine) * BakeVisibility(origin, direction, reach));
}

// Light of the sun and the local lights that a surface reflects, with shadow rays.
float3 DirectAt(PathPayload hit, uint key) {
  const float3 origin = hit.position + hit.normal * hit.offset;
  float3 sum = float3(0, 0, 0);
  if ((constants.lights & kBakeSun) != 0 && any(frame.sun_irradiance > 0.0)) {
    const float3 to_sun =
        SampleSun(Random2(HashCombine(key, 1)), frame.direction_to_sun, frame.tan_sun_radius);
    const float facing = dot(hit.normal, to_sun);
    if (facing > 0.0) {
      sum += frame.sun_irradiance * SpreadAlbedo(hit.brdf, facing) *
             (facing * BakeVisibility(origin, to_sun, kSunDistance));
    }
  }
  if ((constants.lights & kBakeLocal) != 0) {
    const ChosenLight light =
        ChooseLight(hit.position, hit.normal, UnitFloat(PcgHash(HashCombine(key, 2))));
    if (any(light.irradiance > 0.0)) {
      sum += LampAt(hit, origin, light, Random2(HashCombine(key, 3)));
    }
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
  payload.position = payload.normal = payload.emissive = float3(0, 0, 0);
  payload.brdf = MakeSpreadBrdf(0.0);
  payload.offset = -1.0;
  payload.back_face = 0;
  TraceRay(scene, RAY_FLAG_NONE, kMaskBaked, kRayTypeSurface, kRayTypeCount,
           kRayTypeSurface, ray, payload);
  return payload;
}

// Radiance along a ray. `back_face` tells whether the first hit was the back of a surface.
float3 PathRadiance(float3 origin, float3 direction, uint key, out bool back_face) {
  float3 radiance = float3(0, 0, 0);
  float3 throughput = float3(1, 1, 1);
  back_face = false;
  for (uint bounce = 0; bounce <= constants.bounces; ++bounce) {
    const PathPayload hit = TracePath(origin, direction);
    if (hit.offset < 0.0) {
      if ((constants.lights & kBakeSky) != 0) radiance += throughput * SkyTowards(direction);
      break;
    }
    if (bounce == 0) back_face = hit.back_face != 0;
    const uint bounce_key = HashCombine(key, bounce + 1);
    float3 reflected = DirectAt(hit, bounce_key);
    if ((constants.lights & kBakeEmissive) != 0) reflected += hit.emissive;
    radiance += throughput * reflected;
    const float3 next =
        ToWorld(SampleCosineHemisphere(Random2(HashCombine(bounce_key, 5))), hit.normal);
    throughput *= SpreadAlbedo(hit.brdf, dot(hit.normal, next));
    // Russian roulette: paths that go on make up for those that end. Not at the first hit, where it
    // would add more noise than it saves time.
    if (bounce > 0) {
      const float goes_on = max(throughput.x, max(throughput.y, throughput.z));
      if (!(UnitFloat(PcgHash(HashCombine(bounce_key, 4))) < goes_on)) break;
      throughput /= goes_on;
    }
    origin = hit.position + hit.normal * hit.offset;
    direction = next;
  }
  return radiance;
}

[shader("raygeneration")]
void BakeRayGen() {
  const uint place = DispatchRaysIndex().y * constants.width + DispatchRaysIndex().x;
  if (place >= constants.task_count) return;
  const uint3 task = tasks[place];
  CellSums sum = sums[task.x];
  const float3 center = cell_centers[task.x / 2].xyz;
  const uint seed = HashCombine(constants.seed, task.x);
  const uint first = task.y + constants.done;
  const uint last = min(task.z, first + constants.sample_count);
  for (uint index = first; index < last; ++index) {
    // Uniform over the sphere.
    const float2 u = SobolOwen(index, seed);
    const float z = 1.0 - 2.0 * u.x;
    const float r = sqrt(max(0.0, 1.0 - z * z));
    const float3 direction = float3(r * cos(6.2831853 * u.y), r * sin(6.2831853 * u.y), z);
    bool back_face;
    const float3 radiance = PathRadiance(center, direction, HashCombine(seed, index), back_face);
    const float luminance = RadianceLuminance(radiance);
    sum.mean += radiance;
    sum.slope_x += 3.0 * radiance * direction.x;
    sum.slope_y += 3.0 * radiance * direction.y;
    sum.slope_z += 3.0 * radiance * direction.z;
    sum.luminance_squared += luminance * luminance;
    sum.back_faces += back_face ? 1.0 : 0.0;
  }
  sums[task.x] = sum;
}

// Rays from a cell's centre to those of 13 of the 26 cells around it, as many in size. The other 13
// see it by the rays of their own.
[shader("raygeneration")]
void SeeRayGen() {
  const uint place = DispatchRaysIndex().y * constants.width + DispatchRaysIndex().x;
  if (place >= constants.task_count) return;
  const uint cell = tasks[place].x / 2;
  const float4 center = cell_centers[cell];
  uint bits = 0;
  for (uint i = 0; i < 13; ++i) {
    const uint at = 14 + i;  // of 3 x 3 x 3, in the order of a brick's cells
    const float3 way = center.w * (float3(at % 3, at / 3 % 3, at / 9) - 1.0);
    const float distance = length(way);
    if (BakeVisibility(center.xyz, way / distance, distance) > 0.0) bits |= 1u << i;
  }
  seen[cell] = bits;
}
