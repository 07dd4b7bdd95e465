// SPDX-License-Identifier: MIT
// The light of a ray that is followed over the picture, with what stands in for it where nothing is
// hit. [survey 6.2; McGuire & Mara 2014]
#ifndef KAAMOS_SCREEN_FOLLOW_HLSLI
#define KAAMOS_SCREEN_FOLLOW_HLSLI

#include "../environment_map/environment_map.hlsli"
#include "screen_light.hlsli"

static const uint kFallbackNone = 0;
static const uint kFallbackSky = 1;
static const uint kFallbackEnvironment = 2;

float3 Fallback(uint fallback, float3 origin, float3 direction) {
  if (fallback == kFallbackSky) return SkyTowards(direction);
  // The ray is one of its lobe already, so that nothing is to be blurred.
  if (fallback == kFallbackEnvironment) return EnvironmentRadiance(origin, direction, 0.0);
  return float3(0, 0, 0);
}

ScreenHit NoHit(uint outcome) {
  ScreenHit hit;
  hit.outcome = outcome;
  hit.distance = 0.0;
  hit.place = float2(0, 0);
  hit.pixel = int2(0, 0);
  return hit;
}

// Radiance along a ray and its length. Without a march it is what a miss shows.
float4 LightOfRay(uint2 pixel, ReflectionPoint surface, ReflectionRay sample,
                  ScreenReflectionConstants screen, bool is_marched, float2 size,
                  out ScreenHit hit) {
  hit = NoHit(kNotLookedFor);
  if (is_marched) hit = MarchReflection(surface, sample, g_ids[pixel].x, screen, size);
  float3 light = Fallback(screen.fallback, surface.origin, sample.direction);
  if (hit.outcome == kHit) {
    const float3 seen = LightOfHit(hit, screen, int2(size));
    if (hit.outcome == kHit) {
      light = lerp(light, seen, EdgeConfidence(hit.place, screen.edge_fade, size));
    }
  }
  return float4(light, hit.outcome == kHit ? hit.distance : sample.length);
}

// Adds up the samples of a pixel as effects/reflections/traced does: radiance / ReflectionScale, and the
// length of the rays. `hit` is that of the last one.
float4 ReflectionSum(uint2 pixel, ScreenReflectionConstants screen, bool is_marched, float2 size,
                     out ScreenHit hit) {
  hit = NoHit(kNoRay);
  float4 sum = float4(0, 0, 0, 0);
  if (g_ids[pixel].x == 0) return sum;
  const ReflectionPoint surface = LoadReflectionPoint(pixel);
  const float3 scale = ReflectionScaleAt(surface);
  for (uint i = 0; i < pass_constants.sample_count; ++i) {
    const ReflectionRay sample = SampleReflectionRay(
        pixel, surface, LengthsOf(screen), pass_constants.first_sample + i, frame.seed);
    hit = NoHit(kNoRay);
    if (!sample.exists) continue;
    const float4 light = LightOfRay(pixel, surface, sample, screen, is_marched, size, hit);
    sum += float4(light.rgb * sample.weight / scale, light.w);
  }
  return sum;
}

#endif
