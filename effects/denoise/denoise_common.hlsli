// SPDX-License-Identifier: MIT
// What all denoising kernels share: the signal's guides and the edge-stopping weights.
// [effects-spec B6]
#ifndef KAAMOS_DENOISE_COMMON_HLSLI
#define KAAMOS_DENOISE_COMMON_HLSLI

#include "frame.hlsli"

// effects/denoise/denoise.h: DenoiseConstants.
struct DenoiseConstants {
  float alpha;          // least weight of the new frame
  float moments_alpha;  // the same for its moments
  float sigma_z;
  float sigma_n;
  float sigma_l;
  float sigma_pixels;  // of the Gaussian
  float clip_gamma;    // history is clipped to mean +- gamma deviations of 3 x 3; 0: it is not
  uint max_history;    // frames
  uint history_valid;  // 0: there is no frame before
  int step;            // texels between taps
  int radius;          // taps to each side
  uint vertical;       // separable filters: 0 rows, 1 columns
  float scale;         // of the loaded signal
};

ConstantBuffer<DenoiseConstants> denoise : register(b0, space3);

float Luminance(float3 color) { return dot(color, float3(0.2126, 0.7152, 0.0722)); }

// The square of more light, summed over a filter, would not be finite.
static const float kMostLight = 1e17;

// Light that is not a number, or infinite, is no light: it may not spread. [effects-spec E.1]
float FiniteOrZero(float light) {
  return isfinite(light) ? clamp(light, -kMostLight, kMostLight) : 0.0;
}
float3 FiniteOrZero(float3 color) {
  return float3(FiniteOrZero(color.x), FiniteOrZero(color.y), FiniteOrZero(color.z));
}

// Change of the view depth from one pixel to the next, on the smaller side, so that an edge of the
// object does not count as a slope. Where the sides go apart, at a ridge or at a pixel that stands
// alone, there is none: rounding would choose between them.
float Smaller(float a, float b) {
  if (!(a * b > 0.0)) return 0.0;
  return abs(a) < abs(b) ? a : b;
}

float2 DepthGradient(int2 pixel, int2 size) {
  const float z = g_view_z[pixel];
  const float left = g_view_z[int2(max(pixel.x - 1, 0), pixel.y)];
  const float right = g_view_z[int2(min(pixel.x + 1, size.x - 1), pixel.y)];
  const float up = g_view_z[int2(pixel.x, max(pixel.y - 1, 0))];
  const float down = g_view_z[int2(pixel.x, min(pixel.y + 1, size.y - 1))];
  // At the border one side has no neighbour.
  const float dx = pixel.x == 0 ? right - z : pixel.x == size.x - 1 ? z - left : Smaller(right - z, z - left);
  const float dy = pixel.y == 0 ? down - z : pixel.y == size.y - 1 ? z - up : Smaller(down - z, z - up);
  return float2(dx, dy);
}

struct Guide {
  float view_z;
  float3 normal;
  float2 gradient;
};

Guide LoadGuide(int2 pixel, int2 size) {
  Guide guide;
  guide.view_z = g_view_z[pixel];
  guide.normal = OctahedralDecode(g_shading_normal[pixel]);
  guide.gradient = DepthGradient(pixel, size);
  return guide;
}

// How much a pixel `offset` away belongs to the same surface. Sky (depth 0) belongs to none.
float GuideWeight(Guide guide, int2 other, int2 offset) {
  const float z = g_view_z[other];
  if (z == 0.0) return 0.0;
  // All relative to the depth: a scene of other units gives the same picture.
  const float slope = denoise.sigma_z * abs(dot(guide.gradient, float2(offset)));
  const float by_depth = exp(-abs(z - guide.view_z) / (slope + 1e-4 * guide.view_z));
  const float3 normal = OctahedralDecode(g_shading_normal[other]);
  return by_depth * pow(saturate(dot(normal, guide.normal)), denoise.sigma_n);
}

bool IsInside(int2 pixel, int2 size) {
  return all(pixel >= int2(0, 0)) && all(pixel < size);
}

#endif
