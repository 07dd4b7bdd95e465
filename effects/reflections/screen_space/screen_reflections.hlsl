// SPDX-License-Identifier: MIT
// Reflections of what the picture shows: the rays of effects/reflections/traced, followed over the depths
// of the picture instead of through the scene. [survey 6.2; McGuire & Mara 2014; GDC 2018 talk]
#include "screen_follow.hlsli"

ConstantBuffer<ScreenReflectionConstants> constants : register(b0, space3);

// Sums over samples, as those of effects/reflections/traced: radiance / ReflectionScale, and the length of
// the ray (0: no ray).
RWTexture2D<float4> reflection : register(u0, space3);
// The last sample: where in the picture the ray hit (pixels), how far away (metres), and how the
// march ended.
RWTexture2D<float4> hits : register(u1, space3);

[shader("compute")]
[numthreads(8, 8, 1)]
void ScreenReflections(uint3 id : SV_DispatchThreadID) {
  const uint2 pixel = TracedPixel(id.xy);
  const float2 size = PictureSize();
  if (any(float2(pixel) >= size)) return;
  ScreenHit hit;
  const float4 sum = ReflectionSum(pixel, constants, true, size, hit);
  reflection[pixel] = SumBefore(reflection, pixel) + sum;
  hits[pixel] = float4(hit.place, hit.distance, float(hit.outcome));
}
