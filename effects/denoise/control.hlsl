// SPDX-License-Identifier: MIT
// The reflection denoiser of Control in three stages: clamp fireflies, accumulate over frames,
// filter twice in rows and columns. What is taken from fireflies goes to their neighbours, unless
// keep_energy is 0: Control loses it. [Control; survey: Table 1]
//
// The accumulation is that of svgf.hlsl with the history clipped to the neighbours. Contact shadows
// and indirect light use the same stages with lobe_scale 0: a fixed radius, and no hit distances.
#include "denoise_common.hlsli"

RWTexture2D<float4> source : register(u0, space3);  // light; w: mean distance of the hits, metres
RWTexture2D<float4> result : register(u1, space3);
// Output of the first stage, with hit distances averaged over 3 x 3 pixels in w.
RWTexture2D<float4> clamped : register(u2, space3);

// Radius in pixels over which a reflection lobe of this roughness spreads what it sees at
// `distance`; 0 for a mirror.
float FootprintRadius(float roughness, float distance, float view_z) {
  const float tangent = roughness * roughness;  // alpha: half of the lobe lies within
  const float seen =
      frame.is_orthographic != 0 ? distance : distance / max(distance + view_z, 1e-20);
  return denoise.lobe_scale * tangent * seen / frame.pixel_angle;
}

float SmoothnessWeight(int2 pixel, int2 other) {
  return exp(-abs(g_material[other].x - g_material[pixel].x) / denoise.sigma_roughness);
}

// Clamps a pixel to the brightest of its neighbours on the same surface.
[shader("compute")]
[numthreads(8, 8, 1)]
void ClampFireflies(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(result);
  if (!IsInside(pixel, size)) return;
  const float4 own = source[pixel];
  float3 color = FiniteOrZero(own.rgb);
  if (guides[pixel].w == 0.0) {
    result[pixel] = float4(color, 0.0);
    return;
  }
  const Guide guide = LoadGuide(pixel, size);
  float brightest = -1.0;
  float distance = isfinite(own.w) ? max(own.w, 0.0) : 0.0;
  float weights = 1.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const int2 offset = int2(x, y);
      const int2 other = pixel + offset;
      if ((x == 0 && y == 0) || !IsInside(other, size)) continue;
      float weight = GuideWeight(guide, other, offset);
      if (denoise.lobe_scale > 0.0) weight *= SmoothnessWeight(pixel, other);
      if (!(weight > 0.0)) continue;
      const float4 tap = source[other];
      if (weight > 0.1) brightest = max(brightest, Luminance(FiniteOrZero(tap.rgb)));
      distance += weight * (isfinite(tap.w) ? max(tap.w, 0.0) : 0.0);
      weights += weight;
    }
  }
  distance /= weights;
  // An image in a mirror is not noise, even if it is as small as a pixel.
  const bool is_mirror = denoise.lobe_scale > 0.0 &&
                         FootprintRadius(g_material[pixel].x, distance, guide.view_z) < 1.0;
  const float luminance = Luminance(color);
  if (!is_mirror && brightest >= 0.0 && luminance > brightest) color *= brightest / luminance;
  result[pixel] = float4(color, distance);
}

// The share of the light that is taken from `other` and goes to the pixel `offset` away from it.
float SpreadWeight(Guide guide, int2 other, int2 offset, int2 size) {
  if (all(offset == 0)) return 1.0;
  if (!IsInside(other + offset, size)) return 0.0;
  return GuideWeight(guide, other + offset, offset);
}

// Gives what ClampFireflies took to the 3 x 3 pixels around, as far as they show the same surface.
[shader("compute")]
[numthreads(8, 8, 1)]
void SpreadFireflies(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(result);
  if (!IsInside(pixel, size)) return;
  float3 sum = clamped[pixel].rgb;
  for (int i = 0; i < 9 && guides[pixel].w != 0.0; ++i) {
    const int2 to_other = int2(i % 3 - 1, i / 3 - 1);
    const int2 other = pixel + to_other;
    if (!IsInside(other, size) || guides[other].w == 0.0) continue;
    const float3 taken = FiniteOrZero(source[other].rgb) - clamped[other].rgb;
    if (!any(taken > 0.0)) continue;
    const Guide guide = LoadGuide(other, size);
    float weights = 0.0;
    for (int k = 0; k < 9; ++k) {
      weights += SpreadWeight(guide, other, int2(k % 3 - 1, k / 3 - 1), size);
    }
    sum += taken * (SpreadWeight(guide, other, -to_other, size) / weights);
  }
  result[pixel] = float4(sum, clamped[pixel].w);
}

// One row or column of the filter: `radius` taps to each side within the lobe's footprint.
[shader("compute")]
[numthreads(8, 8, 1)]
void FilterLobe(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(result);
  if (!IsInside(pixel, size)) return;
  const float4 own = source[pixel];
  if (guides[pixel].w == 0.0) {
    result[pixel] = own;
    return;
  }
  const bool by_lobe = denoise.lobe_scale > 0.0;
  const Guide guide = LoadGuide(pixel, size);
  const float distance = clamped[pixel].w;
  const float roughness = g_material[pixel].x;
  const float taps = float(denoise.radius);
  const float wanted = by_lobe ? FootprintRadius(roughness, distance, guide.view_z) : taps;
  // The second iteration is half as wide; it fills the gaps between the taps of the first.
  const float radius = min(wanted, denoise.sigma_pixels) / float(denoise.step);
  const float spacing = max(radius / max(taps, 1.0), 1.0);
  const int2 direction = denoise.vertical != 0 ? int2(0, 1) : int2(1, 0);
  float3 sum = own.rgb;
  float weights = 1.0;
  for (int i = -denoise.radius; i <= denoise.radius; ++i) {
    const float away = round(float(i) * spacing);
    if (i == 0 || abs(away) > radius) continue;
    const int2 offset = int(away) * direction;
    const int2 other = pixel + offset;
    if (!IsInside(other, size)) continue;
    float weight = GuideWeight(guide, other, offset);
    if (weight == 0.0) continue;
    const float part = away / radius;
    weight *= exp(-2.0 * part * part);
    if (by_lobe) {
      const float hit = clamped[other].w;
      const float farther = max(max(hit, distance), 1e-20);
      weight *= exp(-abs(hit - distance) / (denoise.sigma_hit * farther)) *
                SmoothnessWeight(pixel, other);
    }
    if (!(weight > kNoWeight)) continue;
    sum += weight * source[other].rgb;
    weights += weight;
  }
  result[pixel] = float4(sum / weights, own.w);
}
