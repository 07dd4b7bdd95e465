// SPDX-License-Identifier: MIT
// Filters within one picture: a separable Gaussian and bilateral filters. [survey 4.1]
#include "denoise_common.hlsli"

RWTexture2D<float4> source : register(u0, space3);
RWTexture2D<float4> result : register(u1, space3);
RWTexture2D<float> scalar_source : register(u2, space3);

// Prepares the guides that all other passes of the frame read.
[shader("compute")]
[numthreads(8, 8, 1)]
void PrepareGuides(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  if (!IsInside(pixel, SizeOf(guides))) return;
  const float z = g_view_z[pixel];
  const float4 guide = float4(OctahedralDecode(g_shading_normal[pixel]), z);
  // A NaN would spread from here, so such a pixel gets no guide.
  guides[pixel] = z > 0.0 && all(isfinite(guide)) ? guide : float4(0, 0, 0, 0);
}

// Turns a sum of one channel into a signal of three equal channels.
[shader("compute")]
[numthreads(8, 8, 1)]
void LoadScalar(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  if (!IsInside(pixel, SizeOf(result))) return;
  const float value = scalar_source[pixel] * denoise.scale;
  result[pixel] = float4(value, value, value, 0.0);
}

// Turns a sum over samples into a signal: the mean.
[shader("compute")]
[numthreads(8, 8, 1)]
void LoadColor(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  if (!IsInside(pixel, SizeOf(result))) return;
  result[pixel] = source[pixel] * denoise.scale;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void Copy(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  if (!IsInside(pixel, SizeOf(result))) return;
  result[pixel] = source[pixel];
}

float GaussianWeight(int2 offset) {
  // The pixel itself counts in full, whatever the filter's width.
  if (all(offset == int2(0, 0))) return 1.0;
  const float2 o = float2(offset);
  return exp(-dot(o, o) / (2.0 * denoise.sigma_pixels * denoise.sigma_pixels));
}

// Blurs across every edge. The talk warns against it; it is here for comparison.
[shader("compute")]
[numthreads(8, 8, 1)]
void Gaussian(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(result);
  if (!IsInside(pixel, size)) return;
  const int2 direction = denoise.vertical != 0 ? int2(0, 1) : int2(1, 0);
  float3 sum = float3(0, 0, 0);
  float weights = 0.0;
  for (int i = -denoise.radius; i <= denoise.radius; ++i) {
    const int2 other = pixel + i * direction;
    if (!IsInside(other, size)) continue;
    const float weight = GaussianWeight(i * direction);
    sum += weight * FiniteOrZero(source[other].rgb);
    weights += weight;
  }
  result[pixel] = float4(sum / weights, 0.0);
}

struct BilateralSum {
  float3 color;
  float weight;
};

void AddBilateral(inout BilateralSum sum, Guide guide, float3 center, int2 pixel, int2 offset,
                  int2 size) {
  const int2 other = pixel + offset;
  if (!IsInside(other, size)) return;
  const float3 color = FiniteOrZero(source[other].rgb);
  const float difference = Luminance(color) - Luminance(center);
  float weight = GaussianWeight(offset);
  // The pixel itself always counts in full.
  if (any(offset != int2(0, 0))) {
    weight *= GuideWeight(guide, other, offset);
    if (denoise.sigma_l > 0.0) {
      weight *= exp(-difference * difference / (2.0 * denoise.sigma_l * denoise.sigma_l));
    }
  }
  sum.color += weight * color;
  sum.weight += weight;
}

// First rows, then columns: close to the exact filter below, and much cheaper.
[shader("compute")]
[numthreads(8, 8, 1)]
void BilateralSeparable(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(result);
  if (!IsInside(pixel, size)) return;
  const Guide guide = LoadGuide(pixel, size);
  const int2 direction = denoise.vertical != 0 ? int2(0, 1) : int2(1, 0);
  const float3 center = FiniteOrZero(source[pixel].rgb);
  BilateralSum sum;
  sum.color = float3(0, 0, 0);
  sum.weight = 0.0;
  for (int i = -denoise.radius; i <= denoise.radius; ++i) {
    AddBilateral(sum, guide, center, pixel, i * direction, size);
  }
  result[pixel] = float4(sum.color / sum.weight, 0.0);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void BilateralExact(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(result);
  if (!IsInside(pixel, size)) return;
  const Guide guide = LoadGuide(pixel, size);
  const float3 center = FiniteOrZero(source[pixel].rgb);
  BilateralSum sum;
  sum.color = float3(0, 0, 0);
  sum.weight = 0.0;
  for (int y = -denoise.radius; y <= denoise.radius; ++y) {
    for (int x = -denoise.radius; x <= denoise.radius; ++x) {
      AddBilateral(sum, guide, center, pixel, int2(x, y), size);
    }
  }
  result[pixel] = float4(sum.color / sum.weight, 0.0);
}
