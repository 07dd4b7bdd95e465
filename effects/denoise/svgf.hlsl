// SPDX-License-Identifier: MIT
// Temporal reprojection and spatiotemporal variance-guided filtering. [effects-spec B6.2, B6.3;
// Schied et al. 2017]
#include "denoise_common.hlsli"

// signal: this frame's noisy light. accumulated: rgb and variance of the luminance. moments: first
// and second moment of the luminance, frames of history, instance.
RWTexture2D<float4> signal : register(u0, space3);
RWTexture2D<float4> history : register(u1, space3);
RWTexture2D<float4> previous_moments : register(u2, space3);
RWTexture2D<float4> accumulated : register(u4, space3);
RWTexture2D<float4> moments : register(u5, space3);
RWTexture2D<float4> previous_guides : register(u6, space3);

struct Reprojected {
  float4 color;
  float4 moments;
  float weight;  // 0: this surface was not seen one frame ago
};

// What is here now, for the search of where it was one frame ago.
struct Surface {
  float3 normal;
  float expected_z;
  float tolerance;
  float instance;
};

bool IsSameSurface(float4 guide, float instance, Surface surface) {
  return guide.w != 0.0 && instance == surface.instance &&
         abs(guide.w - surface.expected_z) <= surface.tolerance &&
         dot(guide.xyz, surface.normal) >= 0.9;
}

// The four pixels about where this one was, those of another surface left out.
Reprojected Reproject(int2 pixel, int2 size) {
  Reprojected result;
  result.color = float4(0, 0, 0, 0);
  result.moments = float4(0, 0, 0, 0);
  result.weight = 0.0;
  if (denoise.history_valid == 0) return result;
  const float4 motion = g_motion[pixel];
  if (!isfinite(motion.x) || !isfinite(motion.y)) return result;
  const float2 before = float2(pixel) + motion.xy * float2(size);
  // Far outside of the picture the conversion to integers would overflow.
  if (any(before < float2(-1, -1)) || any(before > float2(size))) return result;
  const float2 gradient = DepthGradient(pixel, size);
  Surface surface;
  surface.normal = guides[pixel].xyz;
  surface.expected_z = guides[pixel].w + motion.z;
  surface.tolerance = 2.0 * (abs(gradient.x) + abs(gradient.y)) + 0.01 * surface.expected_z;
  surface.instance = float(g_ids[pixel].x);
  const float2 corner = floor(before);
  const float2 part = before - corner;
  for (int i = 0; i < 4; ++i) {
    const int2 offset = int2(i & 1, i >> 1);
    const int2 tap = int2(corner) + offset;
    if (!IsInside(tap, size)) continue;
    const float4 tap_moments = previous_moments[tap];
    if (!IsSameSurface(previous_guides[tap], tap_moments.w, surface)) continue;
    const float weight = (offset.x == 1 ? part.x : 1.0 - part.x) *
                         (offset.y == 1 ? part.y : 1.0 - part.y);
    result.color += weight * history[tap];
    result.moments += weight * tap_moments;
    result.weight += weight;
  }
  // Less than a hundredth of a pixel is rounding, not history.
  if (result.weight < 0.01) {
    result.weight = 0.0;
    return result;
  }
  result.color /= result.weight;
  result.moments /= result.weight;
  // What is not a number would stay for ever.
  if (!all(isfinite(result.color)) || !all(isfinite(result.moments))) result.weight = 0.0;
  return result;
}

// Mean and deviation of the new light in 3 x 3 pixels bound the history: what changed is let go.
float3 ClipToNeighbours(float3 color, int2 pixel, int2 size) {
  float3 sum = float3(0, 0, 0);
  float3 squares = float3(0, 0, 0);
  float count = 0.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const int2 other = pixel + int2(x, y);
      if (!IsInside(other, size) || guides[other].w == 0.0) continue;
      const float3 c = FiniteOrZero(signal[other].rgb);
      sum += c;
      squares += c * c;
      count += 1.0;
    }
  }
  const float3 mean = sum / count;
  const float3 deviation = sqrt(max(squares / count - mean * mean, float3(0, 0, 0)));
  return clamp(color, mean - denoise.clip_gamma * deviation, mean + denoise.clip_gamma * deviation);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void TemporalAccumulation(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(guides);
  if (!IsInside(pixel, size)) return;
  const float3 color = FiniteOrZero(signal[pixel].rgb);
  if (guides[pixel].w == 0.0) {
    accumulated[pixel] = float4(color, 0.0);
    moments[pixel] = float4(0, 0, 0, 0);
    return;
  }
  const float instance = float(g_ids[pixel].x);
  const float luminance = Luminance(color);
  const float2 now = float2(luminance, luminance * luminance);
  Reprojected before = Reproject(pixel, size);
  if (before.weight == 0.0) {
    accumulated[pixel] = float4(color, 0.0);
    moments[pixel] = float4(now, 1.0, instance);
    return;
  }
  if (denoise.clip_gamma > 0.0) {
    before.color.rgb = ClipToNeighbours(before.color.rgb, pixel, size);
  }
  const float frames = min(before.moments.z + 1.0, float(denoise.max_history));
  const float alpha = max(denoise.alpha, 1.0 / frames);
  const float moments_alpha = max(denoise.moments_alpha, 1.0 / frames);
  const float2 mixed = lerp(before.moments.xy, now, moments_alpha);
  accumulated[pixel] = float4(lerp(before.color.rgb, color, alpha),
                              max(mixed.y - mixed.x * mixed.x, 0.0));
  moments[pixel] = float4(mixed, frames, instance);
}

// Where there are too few frames for a variance over time, over 7 x 7 pixels of the same surface.
[shader("compute")]
[numthreads(8, 8, 1)]
void EstimateVariance(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(guides);
  if (!IsInside(pixel, size)) return;
  const float frames = moments[pixel].z;
  const float4 color = accumulated[pixel];
  if (guides[pixel].w == 0.0 || frames >= 4.0) {
    previous_moments[pixel] = color;  // the picture is free by now: the filter's first input
    return;
  }
  const Guide guide = LoadGuide(pixel, size);
  float2 sum = moments[pixel].xy;
  float3 color_sum = color.rgb;
  float weights = 1.0;
  for (int y = -3; y <= 3; ++y) {
    for (int x = -3; x <= 3; ++x) {
      const int2 offset = int2(x, y);
      const int2 other = pixel + offset;
      if (all(offset == int2(0, 0)) || !IsInside(other, size)) continue;
      const float weight = GuideWeight(guide, other, offset);
      if (weight == 0.0) continue;
      sum += weight * moments[other].xy;
      color_sum += weight * accumulated[other].rgb;
      weights += weight;
    }
  }
  sum /= weights;
  const float variance = max(sum.y - sum.x * sum.x, 0.0) * (4.0 / max(frames, 1.0));
  previous_moments[pixel] = float4(color_sum / weights, variance);
}

// The variance that guides the luminance weight, itself smoothed. [Schied et al. 2017, equation 5]
float SmoothVariance(int2 pixel, int2 size) {
  float sum = 0.0;
  float weights = 0.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const int2 other = pixel + int2(x, y);
      if (!IsInside(other, size)) continue;
      const float weight = (x == 0 ? 0.5 : 0.25) * (y == 0 ? 0.5 : 0.25);
      sum += weight * signal[other].w;
      weights += weight;
    }
  }
  return sum / weights;
}

// One pass of the a-trous wavelet filter: signal (u0) to accumulated (u4), taps `step` pixels apart.
[shader("compute")]
[numthreads(8, 8, 1)]
void Atrous(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(guides);
  if (!IsInside(pixel, size)) return;
  const float4 center = signal[pixel];
  if (guides[pixel].w == 0.0) {
    accumulated[pixel] = center;
    return;
  }
  const float kernel[3] = {0.375, 0.25, 0.0625};  // the cubic B-spline, from its middle
  const float deviation = sqrt(max(SmoothVariance(pixel, size), 0.0));
  if (deviation == 0.0) {
    // Without variance there is no noise: only equal light would be mixed.
    accumulated[pixel] = center;
    return;
  }
  const Guide guide = LoadGuide(pixel, size);
  const float luminance = Luminance(center.rgb);
  // Light that is equal but for rounding is mixed in any case. A variance is a difference of squares,
  // so rounding alone makes it 1e-7 of the light's square.
  const float per_luminance =
      1.0 / (denoise.sigma_l * max(deviation, 1e-3 * luminance) + 1e-30);
  float weights = kernel[0] * kernel[0];
  float3 color = center.rgb * weights;
  float variance = center.w * weights * weights;
  const int step = denoise.step;
  for (int y = -2; y <= 2; ++y) {
    const int row = pixel.y + y * step;
    if (row < 0 || row >= size.y) continue;
    for (int x = -2; x <= 2; ++x) {
      const int2 offset = int2(x, y) * step;
      const int2 other = pixel + offset;
      if ((x == 0 && y == 0) || other.x < 0 || other.x >= size.x) continue;
      const float4 tap_guide = guides[other];
      const float by_normal = NormalWeight(guide, tap_guide);
      if (by_normal < kNoWeight) continue;
      const float4 tap = signal[other];
      const float distance = DepthDistance(guide, tap_guide, offset) +
                             abs(Luminance(tap.rgb) - luminance) * per_luminance;
      if (!(distance <= kNoWeightLogarithm)) continue;  // or not a number
      const float weight = kernel[abs(x)] * kernel[abs(y)] * by_normal * exp(-distance);
      color += weight * tap.rgb;
      variance += weight * weight * tap.w;
      weights += weight;
    }
  }
  accumulated[pixel] = float4(color / weights, variance / (weights * weights));
}
