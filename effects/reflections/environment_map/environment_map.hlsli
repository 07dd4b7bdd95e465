// SPDX-License-Identifier: MIT
// Radiance from all sides at a few points of the scene, as cubes whose levels are blurred for
// rougher and rougher surfaces. [survey 6.2; Lagarde & Zanuttini 2012]
#ifndef KAAMOS_ENVIRONMENT_MAP_HLSLI
#define KAAMOS_ENVIRONMENT_MAP_HLSLI

#include "frame.hlsli"

// effects/reflections/environment_map/environment_map.h binds these to a pass.
struct EnvironmentProbe {
  float3 position;  // relative to the camera
  float padding0;
  float3 box_min;   // the walls that its picture is taken to show, relative to the camera
  float padding1;
  float3 box_max;
  float padding2;
};
TextureCubeArray<float4> environment_cubes : register(t5, space3);
StructuredBuffer<EnvironmentProbe> environment_probes : register(t6, space3);
SamplerState environment_sampler : register(s0, space3);  // linear

// Parts of the diagonal of a probe's box, so that no unit of length matters.
static const float kNearProbe = 0.015625;  // closer than this, probes count alike
static const float kProbeFade = 0.125;     // as far outside of its box a probe hardly counts
static const float kOnWall = 0.015625;     // what lies on a wall may stand out so far

// Returns how far a point is outside of a box, in parts of its diagonal.
float DistanceToBox(EnvironmentProbe probe, float3 position) {
  return length(position - clamp(position, probe.box_min, probe.box_max)) /
         length(probe.box_max - probe.box_min);
}

// Returns where a ray from inside the box leaves it, seen from the probe: what its cube shows there
// is what the ray meets. From outside the box, returns `direction` itself.
float3 ParallaxCorrected(EnvironmentProbe probe, float3 position, float3 direction) {
  if (DistanceToBox(probe, position) > kOnWall) return direction;
  const float3 inside = clamp(position, probe.box_min, probe.box_max);
  float nearest = kLongestRay;
  for (uint i = 0; i < 3; ++i) {
    const float wall = direction[i] > 0.0 ? probe.box_max[i] : probe.box_min[i];
    if (direction[i] != 0.0) nearest = min(nearest, (wall - inside[i]) / direction[i]);
  }
  return inside + direction * nearest - probe.position;
}

// Radiance that arrives from about a direction at a rough surface. Probes whose box the point lies
// in count by how near they are; others fade out.
float3 EnvironmentRadiance(float3 position, float3 direction, float roughness) {
  uint count, stride;
  environment_probes.GetDimensions(count, stride);
  uint width, height, cubes, levels;
  environment_cubes.GetDimensions(0, width, height, cubes, levels);
  const float level = saturate(roughness) * float(levels - 1);
  float3 sum = float3(0, 0, 0);
  float weights = 0.0;
  for (uint i = 0; i < count; ++i) {
    const EnvironmentProbe probe = environment_probes[i];
    const float diagonal = length(probe.box_max - probe.box_min);
    const float3 from_probe = (position - probe.position) / diagonal;
    const float outside = DistanceToBox(probe, position);
    const float near = 1.0 / (dot(from_probe, from_probe) + kNearProbe * kNearProbe);
    const float weight = max(1e-4, 1.0 - outside / kProbeFade) * near * near;
    const float3 towards = ParallaxCorrected(probe, position, direction);
    sum += weight * environment_cubes.SampleLevel(environment_sampler, float4(towards, float(i)),
                                                  level).rgb;
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : SkyTowards(direction);
}

#endif
