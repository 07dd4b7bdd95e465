// SPDX-License-Identifier: MIT
// Control's denoiser of reflections in three stages: fireflies, accumulation over frames, a filter in
// space twice in each direction. [effects-spec B6.5; Control, survey table 1]
//
// The accumulation is svgf.hlsl's, with history clipped to the neighbours. Contact shadows and
// indirect light take the same way with lobe_scale 0: a fixed radius, no distances of hits.
#include "denoise_common.hlsli"

RWTexture2D<float4> source : register(u0, space3);  // light; w: mean distance of the hits, metres
RWTexture2D<float4> result : register(u1, space3);
// What the first stage wrote, with hit distances of 3 x 3 pixels in w.
RWTexture2D<float4> clamped : register(u2, space3);

// Pixels over which a lobe of that roughness spreads what it sees at that distance. A mirror: none.
float FootprintRadius(float roughness, float distance, float view_z) {
  const float tangent = roughness * roughness;  // alpha: half the lobe lies within
  const float seen = distance / max(distance + view_z, 1e-20);
  return denoise.lobe_scale * tangent * seen / frame.pixel_angle;
}

float SmoothnessWeight(int2 pixel, int2 other) {
  return exp(-abs(g_material[other].x - g_material[pixel].x) / denoise.sigma_roughness);
}

// A pixel may not be brighter than the brightest of its neighbours on the same surface.
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
  // What a mirror shows is no noise, even if it is as small as a pixel.
  const bool is_mirror = denoise.lobe_scale > 0.0 &&
                         FootprintRadius(g_material[pixel].x, distance, guide.view_z) < 1.0;
  const float luminance = Luminance(color);
  if (!is_mirror && brightest >= 0.0 && luminance > brightest) color *= brightest / luminance;
  result[pixel] = float4(color, distance);
}

// Rows or columns, `radius` taps to each side of what the lobe covers.
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
  // The second time half as wide: it fills what the first left out.
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
