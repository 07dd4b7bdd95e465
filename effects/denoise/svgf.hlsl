// SPDX-License-Identifier: MIT
// Temporal reprojection and spatiotemporal variance-guided filtering. [effects-spec B6.2, B6.3;
// Schied et al. 2017]
#include "denoise_common.hlsli"

// signal: this frame's noisy light. accumulated: rgb and variance of the luminance. moments: first
// and second moment of the luminance, frames of history.
RWTexture2D<float4> signal : register(u0, space3);
RWTexture2D<float4> history : register(u1, space3);
RWTexture2D<float4> previous_moments : register(u2, space3);
RWTexture2D<float4> previous_guide : register(u3, space3);  // view depth, normal, instance
RWTexture2D<float4> accumulated : register(u4, space3);
RWTexture2D<float4> moments : register(u5, space3);

int2 PictureSize() {
  uint width, height;
  g_view_z.GetDimensions(width, height);
  return int2(width, height);
}

struct Reprojected {
  float4 color;
  float4 moments;
  float weight;  // 0: this surface was not seen one frame ago
};

// Whether what stood at a pixel one frame ago is the surface that is here now.
bool IsSameSurface(float4 guide, float expected_z, float slope, float3 normal, uint instance) {
  if (guide.x == 0.0) return false;
  if (abs(guide.x - expected_z) > 2.0 * slope + 0.01 * expected_z) return false;
  if (dot(OctahedralDecode(guide.yz), normal) < 0.9) return false;
  return uint(guide.w) == instance;
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
  const float expected_z = g_view_z[pixel] + motion.z;
  const float2 gradient = DepthGradient(pixel, size);
  const float slope = abs(gradient.x) + abs(gradient.y);
  const float3 normal = OctahedralDecode(g_shading_normal[pixel]);
  const uint instance = g_ids[pixel].x;
  const float2 corner = floor(before);
  const float2 part = before - corner;
  for (int i = 0; i < 4; ++i) {
    const int2 offset = int2(i & 1, i >> 1);
    const int2 tap = int2(corner) + offset;
    if (!IsInside(tap, size)) continue;
    if (!IsSameSurface(previous_guide[tap], expected_z, slope, normal, instance)) continue;
    const float weight = (offset.x == 1 ? part.x : 1.0 - part.x) *
                         (offset.y == 1 ? part.y : 1.0 - part.y);
    result.color += weight * history[tap];
    result.moments += weight * previous_moments[tap];
    result.weight += weight;
  }
  // Less than a hundredth of a pixel is rounding, not history.
  if (result.weight < 0.01) {
    result.weight = 0.0;
    return result;
  }
  result.color /= result.weight;
  result.moments /= result.weight;
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
      if (!IsInside(other, size) || g_view_z[other] == 0.0) continue;
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
  const int2 size = PictureSize();
  if (!IsInside(pixel, size)) return;
  const float3 color = FiniteOrZero(signal[pixel].rgb);
  if (g_view_z[pixel] == 0.0) {
    accumulated[pixel] = float4(color, 0.0);
    moments[pixel] = float4(0, 0, 0, 0);
    return;
  }
  const float luminance = Luminance(color);
  const float2 now = float2(luminance, luminance * luminance);
  Reprojected before = Reproject(pixel, size);
  if (before.weight == 0.0) {
    accumulated[pixel] = float4(color, 0.0);
    moments[pixel] = float4(now, 1.0, 0.0);
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
  moments[pixel] = float4(mixed, frames, 0.0);
}

// Where there are too few frames for a variance over time, over 7 x 7 pixels of the same surface.
[shader("compute")]
[numthreads(8, 8, 1)]
void EstimateVariance(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = PictureSize();
  if (!IsInside(pixel, size)) return;
  const float frames = moments[pixel].z;
  const float4 color = accumulated[pixel];
  if (g_view_z[pixel] == 0.0 || frames >= 4.0) {
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
float SmoothVariance(RWTexture2D<float4> picture, int2 pixel, int2 size) {
  float sum = 0.0;
  float weights = 0.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const int2 other = pixel + int2(x, y);
      if (!IsInside(other, size)) continue;
      const float weight = (x == 0 ? 0.5 : 0.25) * (y == 0 ? 0.5 : 0.25);
      sum += weight * picture[other].w;
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
  const int2 size = PictureSize();
  if (!IsInside(pixel, size)) return;
  const float4 center = signal[pixel];
  if (g_view_z[pixel] == 0.0) {
    accumulated[pixel] = center;
    return;
  }
  const float kernel[3] = {0.375, 0.25, 0.0625};  // the cubic B-spline, from its middle
  const Guide guide = LoadGuide(pixel, size);
  const float deviation = sqrt(max(SmoothVariance(signal, pixel, size), 0.0));
  const float luminance = Luminance(center.rgb);
  float weights = kernel[0] * kernel[0];
  float3 color = center.rgb * weights;
  float variance = center.w * weights * weights;
  for (int y = -2; y <= 2; ++y) {
    for (int x = -2; x <= 2; ++x) {
      const int2 offset = int2(x, y) * denoise.step;
      const int2 other = pixel + offset;
      if ((x == 0 && y == 0) || !IsInside(other, size)) continue;
      const float4 tap = signal[other];
      const float difference = abs(Luminance(tap.rgb) - luminance);
      // Without variance there is no noise: only light is mixed that is equal but for rounding. A
      // variance is a difference of squares, so rounding alone makes it 1e-7 of the light's square.
      const float by_luminance =
          exp(-difference / (denoise.sigma_l * max(deviation, 1e-3 * luminance) + 1e-30));
      const float weight = kernel[abs(x)] * kernel[abs(y)] * by_luminance *
                           GuideWeight(guide, other, offset);
      color += weight * tap.rgb;
      variance += weight * weight * tap.w;
      weights += weight;
    }
  }
  accumulated[pixel] = float4(color / weights, variance / (weights * weights));
}

// Keeps what the next frame's reprojection asks of this one.
[shader("compute")]
[numthreads(8, 8, 1)]
void StoreGuide(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  if (!IsInside(pixel, PictureSize())) return;
  previous_guide[pixel] = float4(g_view_z[pixel], g_shading_normal[pixel], float(g_ids[pixel].x));
}
