// SPDX-License-Identifier: MIT
// Opaque reflections: one ray per sample, in a direction drawn from the GGX facets that the camera
// sees, shaded where it hits. [Control; Northlight deck: Reflections]
#include "ray_key.hlsli"
#include "reflection_shading.hlsli"

// Sums over samples: radiance / ReflectionScale, and the length of the ray (0: no ray).
RWTexture2D<float4> reflection : register(u0, space3);

struct ReflectionConstants {
  float longest;        // metres, for a mirror
  float shortest;       // metres, for a rough surface
  float length_jitter;  // fraction of the length that varies from ray to ray
  float firefly_limit;  // of a sample's luminance, in multiples of white; 0: no clamping
  uint sun_at_hits;     // 1: a shadow ray per hit
  uint single_length;   // 1: `longest` for all rays, as a reference
  uint fireflies;       // kKeep, kRetrace, kAverage
  uint more_rays;       // of a sample that is too bright
};
ConstantBuffer<ReflectionConstants> constants : register(b0, space3);

uint SunAtHits() { return constants.sun_at_hits; }

// The treatment of fireflies. [effects/reflections/traced/reflections.h]
static const uint kKeep = 0;
static const uint kRetrace = 1;
static const uint kAverage = 2;
static const float kTooBright = 2.0;  // times white [GDC 2018 talk]
// Added to the frame's seed, so that pilots and further rays are independent of the samples.
static const uint kPilotSeed = 0x9E3779B9;
static const uint kFurtherSeed = 0x85EBCA6B;
// Traces the rays without any shading, to measure what shading costs.
[shader("miss")]
void ReflectionTraceMiss(inout ReflectionPayload payload) {
  payload.distance = -1.0;
}

[shader("closesthit")]
void ReflectionTraceHit(inout ReflectionPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  payload.distance = RayTCurrent();
}

ReflectionLengths Lengths() {
  ReflectionLengths lengths;
  lengths.longest = constants.longest;
  lengths.shortest = constants.single_length != 0 ? constants.longest : constants.shortest;
  lengths.jitter = constants.single_length != 0 ? 0.0 : constants.length_jitter;
  return lengths;
}

// Radiance that the pixel shows of a reflection, and whether it is a firefly.
bool IsTooBright(float3 light, float3 scale) {
  return RadianceLuminance(light * scale) > kTooBright * frame.white;
}

// The light of one ray over `scale`, and the ray's length. `seed` and `index` choose the ray.
float4 TraceReflection(uint2 pixel, ReflectionPoint surface, float3 scale, uint index, uint seed) {
  const ReflectionRay sample = SampleReflectionRay(pixel, surface, Lengths(), index, seed);
  if (!sample.exists) return float4(0, 0, 0, 0);
  const ReflectionPayload payload = FollowReflectionRay(pixel, surface, sample, index, seed);
  float3 light = payload.radiance * sample.weight / scale;
  const float luminance = RadianceLuminance(light * scale);
  const float limit = constants.firefly_limit * frame.white;
  if (limit > 0.0 && luminance > limit) light *= limit / luminance;
  return float4(light, payload.distance >= 0.0 ? payload.distance : sample.length);
}

[shader("raygeneration")]
void ReflectionRayGen() {
  const uint2 pixel = FramePixel();
  if (g_ids[pixel].x == 0) {
    reflection[pixel] = SumBefore(reflection, pixel);
    return;
  }
  const ReflectionPoint surface = LoadReflectionPoint(pixel);
  const float3 scale = ReflectionScaleAt(surface);
  uint rays_per_sample = 1;
  if (constants.fireflies == kRetrace && !IsMirror(surface.roughness)) {
    const float4 pilot = TraceReflection(pixel, surface, scale, pass_constants.first_sample,
                                         frame.seed + kPilotSeed);
    if (IsTooBright(pilot.rgb, scale)) rays_per_sample += constants.more_rays;
  }

  float4 sum = float4(0, 0, 0, 0);
  for (uint i = 0; i < pass_constants.sample_count; ++i) {
    const uint index = pass_constants.first_sample + i;
    uint rays = rays_per_sample;
    float4 sample = float4(0, 0, 0, 0);
    for (uint k = 0; k < rays; ++k) {
      // The first ray is the one that would be traced alone.
      const uint ray_index = k == 0 ? index : index * constants.more_rays + k;
      const uint seed = k == 0 ? frame.seed : frame.seed + kFurtherSeed;
      const float4 one = TraceReflection(pixel, surface, scale, ray_index, seed);
      sample += one;
      if (k == 0 && constants.fireflies == kAverage && IsTooBright(one.rgb, scale)) {
        rays += constants.more_rays;
      }
    }
    sum += sample / float(rays);
  }
  reflection[pixel] = SumBefore(reflection, pixel) + sum;
}

[shader("raygeneration")]
void ReflectionKeys() {
  const uint2 pixel = FramePixel();
  if (g_ids[pixel].x == 0) {
    WriteNoRayKey(pixel);
    return;
  }
  const ReflectionPoint surface = LoadReflectionPoint(pixel);
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, kReflectionPair, frame.seed)];
  const float2 u = PixelSample(tile, pass_constants.first_sample, kReflectionPair, frame.seed);
  const float3 local_light = reflect(-surface.local_view, SampleHalfVector(surface, u));
  WriteRayKey(pixel, surface.origin, ToWorld(local_light, surface.shading_normal),
              ReflectionLength(Lengths(), surface.roughness, 0.0));
}
