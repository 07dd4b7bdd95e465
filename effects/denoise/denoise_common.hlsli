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
  int normal_squarings;  // sigma_n = 2^this; -1: it is another number
  float lobe_scale;      // of the radius that a lobe covers; 0: the radius is fixed
  float sigma_hit;       // difference of hit distances, relative to the farther one
  float sigma_roughness;
  int signals;  // of svgf.hlsl: pictures in each of its arrays
  uint lobes;   // bit s: signal s is of rays in a surface's reflection lobe
};

ConstantBuffer<DenoiseConstants> denoise : register(b0, space3);

// Written once a frame by PrepareGuides, so that no tap decodes anything: shading normal, view depth.
// All zero where there is no surface.
RWTexture2D<float4> guides : register(u3, space3);

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

bool IsInside(int2 pixel, int2 size) {
  return all(pixel >= int2(0, 0)) && all(pixel < size);
}

int2 SizeOf(RWTexture2D<float4> picture) {
  uint width, height;
  picture.GetDimensions(width, height);
  return int2(width, height);
}

// Change of the view depth from one pixel to the next, on the smaller side, so that an edge of the
// object does not count as a slope. Where the sides go apart, at a ridge or at a pixel that stands
// alone, there is none: rounding would choose between them.
float Smaller(float a, float b) {
  if (!(a * b > 0.0)) return 0.0;
  return abs(a) < abs(b) ? a : b;
}

float2 DepthGradient(int2 pixel, int2 size) {
  const float z = guides[pixel].w;
  const float left = guides[int2(max(pixel.x - 1, 0), pixel.y)].w;
  const float right = guides[int2(min(pixel.x + 1, size.x - 1), pixel.y)].w;
  const float up = guides[int2(pixel.x, max(pixel.y - 1, 0))].w;
  const float down = guides[int2(pixel.x, min(pixel.y + 1, size.y - 1))].w;
  // At the border one side has no neighbour.
  const float dx = pixel.x == 0 ? right - z : pixel.x == size.x - 1 ? z - left : Smaller(right - z, z - left);
  const float dy = pixel.y == 0 ? down - z : pixel.y == size.y - 1 ? z - up : Smaller(down - z, z - up);
  return float2(dx, dy);
}

struct Guide {
  float view_z;
  float3 normal;
  float2 gradient;    // times sigma_z
  float least_slope;  // what the depth may change at least
};

Guide LoadGuide(int2 pixel, int2 size) {
  const float4 own = guides[pixel];
  Guide guide;
  guide.view_z = own.w;
  guide.normal = own.xyz;
  guide.gradient = denoise.sigma_z * DepthGradient(pixel, size);
  // All relative to the depth: a scene of other units gives the same picture.
  guide.least_slope = 1e-4 * own.w;
  return guide;
}

// Weights below it, of a sum that begins with some tenths, are less than rounding.
static const float kNoWeight = 1e-12;
static const float kNoWeightLogarithm = 27.6;

// How much the normal of a pixel says that it belongs to the same surface: their cosine to the power
// 2^squarings, or sigma_n where that is -1. Where there is none, 0.
float NormalWeight(Guide guide, float4 other, int squarings) {
  if (other.w == 0.0) return 0.0;
  float weight = saturate(dot(other.xyz, guide.normal));
  // The power 0 of 0 is no number.
  if (squarings < 0) return pow(max(weight, 1e-30), denoise.sigma_n);
  for (int i = 0; i < squarings; ++i) weight *= weight;
  return weight;
}

// The same of its depth, `offset` pixels away: the negative logarithm of the weight.
float DepthDistance(Guide guide, float4 other, int2 offset) {
  const float slope = abs(dot(guide.gradient, float2(offset)));
  return abs(other.w - guide.view_z) / (slope + guide.least_slope);
}

float GuideWeight(Guide guide, int2 pixel, int2 offset) {
  const float4 other = guides[pixel];
  const float weight = NormalWeight(guide, other, denoise.normal_squarings);
  if (weight < kNoWeight) return 0.0;
  const float distance = DepthDistance(guide, other, offset);
  return distance <= kNoWeightLogarithm ? weight * exp(-distance) : 0.0;
}

#endif
