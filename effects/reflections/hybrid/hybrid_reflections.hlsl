// SPDX-License-Identifier: MIT
// Reflections from the picture where it leaves no doubt, and by rays through the scene everywhere
// else. [survey 6.4]
#include "../traced/reflection_shading.hlsli"
#include "picture_hit.hlsli"

// Sums over samples, as those of effects/reflections/traced.
RWTexture2D<float4> reflection : register(u0, space3);
// They belong to the last sample, as those of effects/reflections/screen_space.
RWTexture2D<float4> hits : register(u1, space3);

struct HybridConstants {
  ScreenReflectionConstants screen;
  uint sun_at_hits;      // 1: a shadow ray at each hit of a ray through the scene
  float roughest_screen;  // rougher surfaces are not looked for in the picture
};
ConstantBuffer<HybridConstants> constants : register(b0, space3);

uint SunAtHits() { return constants.sun_at_hits; }

// The light of one ray over `scale`, and the ray's length.
float4 FollowRay(uint2 pixel, ReflectionPoint surface, float3 scale, uint index, float2 size,
                 inout ScreenHit hit) {
  const ReflectionRay sample =
      SampleReflectionRay(pixel, surface, LengthsOf(constants.screen), index, frame.seed);
  hit.outcome = kNoRay;
  if (!sample.exists) return float4(0, 0, 0, 0);
  hit.outcome = kNotLookedFor;
  if (surface.roughness <= constants.roughest_screen) {
    float3 light;
    if (LightOfPicture(pixel, surface, sample, constants.screen, size, hit, light)) {
      return float4(light * sample.weight / scale, hit.distance);
    }
  }
  const ReflectionPayload payload =
      FollowReflectionRay(pixel, surface, sample, index, frame.seed);
  return float4(payload.radiance * sample.weight / scale,
                payload.distance >= 0.0 ? payload.distance : sample.length);
}

[shader("raygeneration")]
void HybridRayGen() {
  const uint2 pixel = FramePixel();
  ScreenHit hit;
  hit.outcome = kNoRay;
  hit.distance = 0.0;
  hit.place = float2(0, 0);
  hit.pixel = int2(0, 0);
  float4 sum = float4(0, 0, 0, 0);
  if (g_ids[pixel].x != 0) {
    const float2 size = PictureSize();
    const ReflectionPoint surface = LoadReflectionPoint(pixel);
    const float3 scale = ReflectionScaleAt(surface);
    for (uint i = 0; i < pass_constants.sample_count; ++i) {
      sum += FollowRay(pixel, surface, scale, pass_constants.first_sample + i, size, hit);
    }
  }
  reflection[pixel] = SumBefore(reflection, pixel) + sum;
  hits[pixel] = float4(hit.place, hit.distance, float(hit.outcome));
}
