// SPDX-License-Identifier: MIT
// The visible fraction of the sun's disk, by rays to random points of it. [GDC 2018 talk;
// Northlight deck: Shadows]
#include "occluder.hlsli"
#include "ray_key.hlsli"
#include "sampling.hlsli"

// Samples that see the sun.
RWTexture2D<float> sun_visibility_sum : register(u0, space3);
// Sums over the other samples: 1 / radius of their penumbra, 1/m, in x, and how many were blocked
// by what moves in z. Not written where nobody reads them.
RWTexture2D<float4> sun_sharpness_sum : register(u1, space3);

float3 SunDirection(float2 tile, uint index) {
  return SampleSun(PixelSample(tile, index, kSunPair, frame.seed), frame.direction_to_sun,
                   frame.tan_sun_radius);
}

[shader("raygeneration")]
void SunShadowRayGen() {
  const uint2 pixel = FramePixel();
  const uint count = pass_constants.sample_count;
  if (g_ids[pixel].x == 0) {
    sun_visibility_sum[pixel] = SumBefore(sun_visibility_sum, pixel) + float(count);
    if (pass_constants.sharpness != 0) sun_sharpness_sum[pixel] = float4(0, 0, 0, 0);
    return;
  }
  const float4 position = g_position[pixel];
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  const float3 origin = position.xyz + normal * position.w;
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, kSunPair, frame.seed)];

  float visible = 0.0;
  float sharpness = 0.0;
  float moved = 0.0;
  for (uint i = 0; i < count; ++i) {
    const float3 direction = SunDirection(tile, pass_constants.first_sample + i);
    // A surface that faces away from this point of the sun is dark without a ray. On a curved one
    // that ends as sharply as where things touch.
    if (!(dot(direction, normal) > 0.0)) {
      sharpness += kSharpest;
      continue;
    }
    if (pass_constants.sharpness == 0) {
      visible += IsOpenTowards(origin, direction, kSunDistance) ? 1.0 : 0.0;
      continue;
    }
    const OccluderPayload occluder = TraceOccluder(origin, direction, kSunDistance);
    if (occluder.distance == kNoOccluder) {
      visible += 1.0;
    } else {
      sharpness += ShadowSharpness(occluder.distance * frame.tan_sun_radius);
      moved += occluder.moved;
    }
  }
  sun_visibility_sum[pixel] = SumBefore(sun_visibility_sum, pixel) + visible;
  if (pass_constants.sharpness == 0) return;
  sun_sharpness_sum[pixel] = SumBefore(sun_sharpness_sum, pixel) + float4(sharpness, 0, moved, 0);
}

[shader("raygeneration")]
void SunShadowKeys() {
  const uint2 pixel = FramePixel();
  if (g_ids[pixel].x == 0) {
    WriteNoRayKey(pixel);
    return;
  }
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, kSunPair, frame.seed)];
  WriteRayKey(pixel, g_position[pixel].xyz, SunDirection(tile, pass_constants.first_sample),
              kSunDistance);
}
