// SPDX-License-Identifier: MIT
// This file holds what all denoising kernels share: guides (depth and normal) and the edge-stopping
// weights made from them.
#ifndef KAAMOS_DENOISE_COMMON_HLSLI
#define KAAMOS_DENOISE_COMMON_HLSLI

#include "frame.hlsli"

// Mirrors DenoiseConstants in effects/denoise/denoise.h.
struct DenoiseConstants {
  float alpha;          // least weight of the new frame
  float moments_alpha;  // the same for its moments
  float sigma_z;
  float sigma_n;
  float sigma_l;
  float sigma_pixels;  // of the Gaussian
  float clip_gamma;    // clips history to mean +- gamma deviations of 3 x 3; 0: no clipping
  uint max_history;    // frames
  uint history_valid;  // 0: there is no previous frame
  int step;            // texels between taps
  int radius;          // taps to each side
  uint vertical;       // separable filters: 0 rows, 1 columns
  float scale;         // factor on the signal when it is loaded
  int normal_squarings;  // sigma_n = 2^this; -1: sigma_n is not a power of two
  float lobe_scale;      // factor on the radius of a lobe's footprint; 0: the radius is fixed
  float sigma_hit;       // of differences of hit distances, relative to the farther one
  float sigma_roughness;
  int signals;  // number of signals that svgf.hlsl filters
  uint lobes;   // bit s: signal s comes from rays in a reflection lobe
  uint changes;  // 4 bits for each signal: 1 + its channel of the changes, 0: nothing is known
  uint pixel_offset;  // which pixel of each 2 x 2 had rays, as PassConstants has it
  uint keep_energy;   // 1: fireflies are spread, and history is clipped by deviations over time too
  float scalar_alpha;  // alpha of scalars
  uint scalars;        // bit s: signal s is a scalar
};

ConstantBuffer<DenoiseConstants> denoise : register(b0, space3);

// Shading normal and view depth, written once per frame by PrepareGuides so that no tap decodes
// anything. All zero where there is no surface.
RWTexture2D<float4> guides : register(u3, space3);

// Returns which pixel of each 2 x 2 had rays in this frame.
int2 TracedOffset() {
  return int2(denoise.pixel_offset & 1u, denoise.pixel_offset >> 1);
}

float Luminance(float3 color) { return dot(color, float3(0.2126, 0.7152, 0.0722)); }

// A filter sums squares of light; those of anything brighter would not stay finite.
static const float kMostLight = 1e17;

// NaN and infinite light become 0, so that they cannot spread.
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

// Change of the view depth from one pixel to the next. The smaller of the two sides counts, so that
// an object's edge is not taken for a slope. If the sides have different signs, as on a ridge or an
// isolated pixel, the slope is 0; otherwise rounding would choose between them.
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
  // At the border, one side has no neighbour.
  const float dx = pixel.x == 0 ? right - z : pixel.x == size.x - 1 ? z - left : Smaller(right - z, z - left);
  const float dy = pixel.y == 0 ? down - z : pixel.y == size.y - 1 ? z - up : Smaller(down - z, z - up);
  return float2(dx, dy);
}

struct Guide {
  float view_z;
  float3 normal;
  float2 gradient;    // change of depth per pixel, times sigma_z
  float least_slope;  // is added to the slope; 1e-4 of the depth
};

Guide LoadGuide(int2 pixel, int2 size) {
  const float4 own = guides[pixel];
  Guide guide;
  guide.view_z = own.w;
  guide.normal = own.xyz;
  guide.gradient = denoise.sigma_z * DepthGradient(pixel, size);
  // Relative to the depth, so that a scene in other units gives the same picture.
  guide.least_slope = 1e-4 * own.w;
  return guide;
}

// Weights are added to a sum of at least some tenths, so smaller ones are below its rounding error.
static const float kNoWeight = 1e-12;
static const float kNoWeightLogarithm = 27.6;

// Normal weight: how likely a pixel belongs to the same surface by its normal. The cosine to the
// power 2^squarings, or sigma_n if squarings is -1; 0 if there is no surface.
float NormalWeight(Guide guide, float4 other, int squarings) {
  if (other.w == 0.0) return 0.0;
  float weight = saturate(dot(other.xyz, guide.normal));
  // pow(0, 0) is NaN.
  if (squarings < 0) return pow(max(weight, 1e-30), denoise.sigma_n);
  for (int i = 0; i < squarings; ++i) weight *= weight;
  return weight;
}

// Depth weight for a pixel `offset` away, as the negative logarithm of the weight.
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
