// SPDX-License-Identifier: MIT
// SVGF: temporal reprojection, then an edge-stopping wavelet filter that adapts to the variance.
// [Schied et al. 2017, Spatiotemporal Variance-Guided Filtering]
//
// Filters several signals at once, because weights by depth and normal are the same for all of
// them. Each signal comes out as it would alone.
#include "brdf.hlsli"
#include "denoise_common.hlsli"

static const int kMostSignals = 5;  // effects/denoise/denoise.h

// signal: this frame's noisy light. accumulated: rgb, and the variance of the luminance. moments:
// first and second moment of the luminance, frames of history, instance.
RWTexture2D<float4> signal[kMostSignals] : register(u4, space3);
RWTexture2D<float4> history[kMostSignals] : register(u9, space3);
RWTexture2D<float4> previous_moments[kMostSignals] : register(u14, space3);
RWTexture2D<float4> accumulated[kMostSignals] : register(u19, space3);
RWTexture2D<float4> moments[kMostSignals] : register(u24, space3);
RWTexture2D<float4> previous_guides : register(u29, space3);
// The change of signals since the previous frame, four in each. [temporal_gradients.hlsl]
RWTexture2D<float4> changes[2] : register(u30, space3);

bool IsOfLobe(int s) { return (denoise.lobes >> s & 1) != 0; }

// Light in a mirror has no noise, however much it varies over the picture. It is not filtered.
bool IsExact(int2 pixel, int s) { return IsOfLobe(s) && IsMirror(g_material[pixel].x); }

// The surface at this pixel, to be found again in the previous frame.
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

// The place of a pixel's surface in the previous frame: how much each of the four pixels there
// shows of it.
struct Past {
  int2 corner;
  float weights[4];  // x runs fastest
  float weight;      // their sum; 0: the surface was not visible
};

Past NoPast(int2 pixel) {
  Past past;
  past.corner = pixel;
  past.weight = 0.0;
  for (int i = 0; i < 4; ++i) past.weights[i] = 0.0;
  return past;
}

// The past of a pixel that `motion` takes to another place of the previous picture, in picture
// widths and heights, where its surface had the view depth `expected_z`.
Past FindPastAt(int2 pixel, int2 size, float2 motion, float expected_z) {
  Past past = NoPast(pixel);
  if (denoise.history_valid == 0) return past;
  if (!isfinite(motion.x) || !isfinite(motion.y)) return past;
  const float2 before = float2(pixel) + motion * float2(size);
  // Far outside the picture, the conversion to integers would overflow.
  if (any(before < float2(-1, -1)) || any(before > float2(size))) return past;
  const float2 gradient = DepthGradient(pixel, size);
  Surface surface;
  surface.normal = guides[pixel].xyz;
  surface.expected_z = expected_z;
  surface.tolerance = 2.0 * (abs(gradient.x) + abs(gradient.y)) + 0.01 * surface.expected_z;
  surface.instance = float(g_ids[pixel].x);
  const float2 corner = floor(before);
  const float2 part = before - corner;
  past.corner = int2(corner);
  for (int j = 0; j < 4; ++j) {
    const int2 offset = int2(j & 1, j >> 1);
    const int2 tap = past.corner + offset;
    if (!IsInside(tap, size)) continue;
    // The moments of every signal hold the same instance.
    if (!IsSameSurface(previous_guides[tap], previous_moments[0][tap].w, surface)) continue;
    past.weights[j] = (offset.x == 1 ? part.x : 1.0 - part.x) *
                      (offset.y == 1 ? part.y : 1.0 - part.y);
    past.weight += past.weights[j];
  }
  // A hundredth of a pixel is rounding error, not history.
  if (past.weight < 0.01) past.weight = 0.0;
  return past;
}

// Finds where the surface itself was.
Past FindPast(int2 pixel, int2 size) {
  const float4 motion = g_motion[pixel];
  return FindPastAt(pixel, size, motion.xy, guides[pixel].w + motion.z);
}

// Mean curvature of the surface, 1/metres, from the neighbours to the right and below; 0 where the
// surface is flat or hollow.
float Convexity(int2 pixel, int2 size, float3 position) {
  float sum = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    const int2 other = pixel + (axis == 0 ? int2(1, 0) : int2(0, 1));
    if (!IsInside(other, size) || g_ids[other].x != g_ids[pixel].x) continue;
    const float3 along = g_position[other].xyz - position;
    sum += dot(guides[other].xyz - guides[pixel].xyz, along) / max(dot(along, along), 1e-20);
  }
  return max(0.5 * sum, 0.0);
}

// Returns how far behind the surface the image of what it reflects stands. The pixel's neighbours
// count as well, because few rays hit at one distance; their places in the picture are averaged,
// which go with 1 / distance. In a convex mirror the image is nearer.
float ImageDistance(int2 pixel, int2 size, int s, float3 position) {
  const float away = length(position);
  float sum = 0.0;
  float count = 0.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const int2 other = pixel + int2(x, y);
      if (!IsInside(other, size) || g_ids[other].x != g_ids[pixel].x) continue;
      const float distance = signal[s][other].w;
      if (!(distance > 0.0)) continue;  // no ray left the surface
      sum += 1.0 / (away + distance);
      count += 1.0;
    }
  }
  if (count == 0.0) return 0.0;
  const float distance = max(count / sum - away, 0.0);
  return distance / (1.0 + 2.0 * distance * Convexity(pixel, size, position));
}

// Returns how much of a reflection moves with the mirrored image rather than with the surface: all
// of it in a mirror, nothing on a rough surface. [Lagarde & de Rousiers 2014, Moving Frostbite to
// PBR: dominant direction of a lobe]
float ImageShare(float roughness) {
  const float smoothness = saturate(1.0 - roughness);
  return smoothness * (sqrt(smoothness) + roughness);
}

// Finds where the reflection that the pixel shows was: the image of what is reflected stands behind
// the surface, and moves across it with the camera. The same surface must have been there.
Past FindPastOfReflection(int2 pixel, int2 size, int s) {
  const float3 position = g_position[pixel].xyz;
  const float3 normal = guides[pixel].xyz;
  const float image = ImageDistance(pixel, size, s, position);
  const float3 before = position + frame.camera_motion;
  const float3 behind = frame.is_orthographic != 0
                            ? frame.camera_forward * image
                            : position * (image / max(length(position), 1e-20));
  float surface_z, image_z;
  const float2 surface = PreviousPictureUv(before, surface_z);
  const float2 mirrored =
      PreviousPictureUv(before + behind, image_z);
  if (!(surface_z > 0.0) || !(image_z > 0.0)) return NoPast(pixel);
  const float2 shift = (mirrored - surface) * ImageShare(g_material[pixel].x);
  // The plane of the surface, there.
  const float2 ndc = (surface + shift) * 2.0 - 1.0;
  const CameraRay ray =
      RayOfCamera(ndc, frame.previous_right, frame.previous_up, frame.previous_forward);
  const float depth = dot(before - ray.origin, normal) / dot(ray.direction, normal);
  if (!(depth > 0.0)) return NoPast(pixel);
  const float4 motion = g_motion[pixel];
  return FindPastAt(pixel, size, motion.xy + shift,
                    (guides[pixel].w + motion.z) * (depth / surface_z));
}

struct Reprojected {
  float4 color;
  float4 moments;
  bool found;
};

Reprojected Reproject(Past past, int s) {
  Reprojected result;
  result.color = float4(0, 0, 0, 0);
  result.moments = float4(0, 0, 0, 0);
  result.found = false;
  if (past.weight == 0.0) return result;
  for (int i = 0; i < 4; ++i) {
    if (past.weights[i] == 0.0) continue;
    const int2 tap = past.corner + int2(i & 1, i >> 1);
    result.color += past.weights[i] * history[s][tap];
    result.moments += past.weights[i] * previous_moments[s][tap];
  }
  result.color /= past.weight;
  result.moments /= past.weight;
  // A NaN in the history would never go away.
  result.found = all(isfinite(result.color)) && all(isfinite(result.moments));
  return result;
}

// With fewer frames than this, the variance comes from 7 x 7 pixels of the same surface instead.
static const float kEnoughFrames = 4.0;
// Light that varies by chance is rarely farther off. Less would clip more below than above, since
// bright samples are few.
static const float kSureDeviations = 3.0;

// Clips the history to mean and deviation of the new light in 3 x 3 pixels, so that outdated light
// is dropped.
float3 ClipToNeighbours(Reprojected before, int2 pixel, int2 size, int s) {
  // Nine pixels of a frame miss light that comes in few bright samples, mostly; history would lose
  // some of it in every frame. It is only wrong where it is off by more than samples vary in time.
  const float2 past = before.moments.xy;
  const float over_time = sqrt(max(past.y - past.x * past.x, 0.0));
  const bool keeps_energy = denoise.keep_energy != 0;
  if (keeps_energy && before.moments.z < kEnoughFrames) return before.color.rgb;
  float3 sum = float3(0, 0, 0);
  float3 squares = float3(0, 0, 0);
  float count = 0.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const int2 other = pixel + int2(x, y);
      if (!IsInside(other, size) || guides[other].w == 0.0) continue;
      const float3 c = FiniteOrZero(signal[s][other].rgb);
      sum += c;
      squares += c * c;
      count += 1.0;
    }
  }
  const float3 mean = sum / count;
  const float3 deviation = sqrt(max(squares / count - mean * mean, float3(0, 0, 0)));
  float3 allowed = denoise.clip_gamma * deviation;
  if (keeps_energy) allowed = max(allowed, kSureDeviations * over_time);
  return clamp(before.color.rgb, mean - allowed, mean + allowed);
}

// 0: light is as it was; 1: none of it is. [Schied et al. 2018]
float ChangeOf(int2 pixel, int s) {
  const uint channel = denoise.changes >> (4 * s) & 15u;
  if (channel == 0) return 0.0;
  return changes[(channel - 1) / 4][pixel][(channel - 1) % 4];
}

void Accumulate(int2 pixel, int2 size, Past past, float instance, int s) {
  const float3 color = FiniteOrZero(signal[s][pixel].rgb);
  const float luminance = Luminance(color);
  const float2 now = float2(luminance, luminance * luminance);
  Reprojected before = Reproject(past, s);
  if (!before.found || IsExact(pixel, s)) {
    accumulated[s][pixel] = float4(color, 0.0);
    moments[s][pixel] = float4(now, 1.0, instance);
    return;
  }
  if (denoise.clip_gamma > 0.0) {
    before.color.rgb = ClipToNeighbours(before, pixel, size, s);
  }
  const float change = ChangeOf(pixel, s);
  const float longer = min(before.moments.z + 1.0, float(denoise.max_history));
  const float frames = lerp(longer, 1.0, change);
  const bool is_scalar = (denoise.scalars >> s & 1) != 0;
  const float least = is_scalar ? denoise.scalar_alpha : denoise.alpha;
  const float alpha = lerp(max(least, 1.0 / longer), 1.0, change);
  const float moments_alpha = lerp(max(denoise.moments_alpha, 1.0 / longer), 1.0, change);
  const float2 mixed = lerp(before.moments.xy, now, moments_alpha);
  accumulated[s][pixel] = float4(lerp(before.color.rgb, color, alpha),
                                 max(mixed.y - mixed.x * mixed.x, 0.0));
  moments[s][pixel] = float4(mixed, frames, instance);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void TemporalAccumulation(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(guides);
  if (!IsInside(pixel, size)) return;
  if (guides[pixel].w == 0.0) {
    for (int i = 0; i < denoise.signals; ++i) {
      accumulated[i][pixel] = float4(FiniteOrZero(signal[i][pixel].rgb), 0.0);
      moments[i][pixel] = float4(0, 0, 0, 0);
    }
    return;
  }
  const Past past = FindPast(pixel, size);
  const float instance = float(g_ids[pixel].x);
  for (int s = 0; s < denoise.signals; ++s) {
    Past own = past;
    if (IsOfLobe(s) && !IsExact(pixel, s)) {
      own = FindPastOfReflection(pixel, size, s);
      if (own.weight == 0.0) own = past;
    }
    Accumulate(pixel, size, own, instance, s);
  }
}

[shader("compute")]
[numthreads(8, 8, 1)]
void EstimateVariance(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(guides);
  if (!IsInside(pixel, size)) return;
  const bool surface = guides[pixel].w != 0.0;
  bool few = false;
  for (int i = 0; i < denoise.signals; ++i) few = few || moments[i][pixel].z < kEnoughFrames;
  // previous_moments is no longer needed and holds the filter's first input.
  if (!surface || !few) {
    for (int j = 0; j < denoise.signals; ++j) previous_moments[j][pixel] = accumulated[j][pixel];
    return;
  }
  const Guide guide = LoadGuide(pixel, size);
  float shares[49];
  for (int k = 0; k < 49; ++k) {
    const int2 offset = int2(k % 7 - 3, k / 7 - 3);
    const int2 other = pixel + offset;
    shares[k] = IsInside(other, size) ? GuideWeight(guide, other, offset) : 0.0;
  }
  shares[24] = 1.0;  // the pixel itself always counts in full
  for (int s = 0; s < denoise.signals; ++s) {
    const float frames = moments[s][pixel].z;
    if (frames >= kEnoughFrames || IsExact(pixel, s)) {
      previous_moments[s][pixel] = accumulated[s][pixel];
      continue;
    }
    float2 sum = float2(0, 0);
    float3 color_sum = float3(0, 0, 0);
    float weights = 0.0;
    for (int t = 0; t < 49; ++t) {
      if (shares[t] == 0.0) continue;
      const int2 other = pixel + int2(t % 7 - 3, t / 7 - 3);
      sum += shares[t] * moments[s][other].xy;
      color_sum += shares[t] * accumulated[s][other].rgb;
      weights += shares[t];
    }
    sum /= weights;
    const float variance = max(sum.y - sum.x * sum.x, 0.0) * (4.0 / max(frames, 1.0));
    previous_moments[s][pixel] = float4(color_sum / weights, variance);
  }
}

// The variance for the luminance weight, smoothed in 3 x 3. [Schied et al. 2017, equation 5]
float SmoothVariance(int2 pixel, int2 size, int s) {
  float sum = 0.0;
  float weights = 0.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const int2 other = pixel + int2(x, y);
      if (!IsInside(other, size)) continue;
      const float weight = (x == 0 ? 0.5 : 0.25) * (y == 0 ? 0.5 : 0.25);
      sum += weight * signal[s][other].w;
      weights += weight;
    }
  }
  return sum / weights;
}

// The pixels that a pass of the wavelet filter mixes: 5 x 5, `step` pixels apart.
static const int kTaps = 25;
int2 TapOffset(int tap) { return int2(tap % 5 - 2, tap / 5 - 2); }

// Weight of each tap by kernel, depth and normal, as share * exp(-distance); share 0 outside the
// picture or on another surface.
struct Taps {
  float shares[kTaps];
  float distances[kTaps];
};

Taps WeighTaps(Guide guide, int2 pixel, int2 size) {
  const float kernel[3] = {0.375, 0.25, 0.0625};  // cubic B-spline, from its centre
  Taps taps;
  for (int i = 0; i < kTaps; ++i) {
    taps.shares[i] = 0.0;
    taps.distances[i] = 0.0;
    const int2 place = TapOffset(i);
    const int2 offset = place * denoise.step;
    const int2 other = pixel + offset;
    if (!IsInside(other, size)) continue;
    const float4 tap_guide = guides[other];
    const float by_normal = NormalWeight(guide, tap_guide, denoise.normal_squarings);
    const float distance = DepthDistance(guide, tap_guide, offset);
    if (by_normal < kNoWeight || !(distance <= kNoWeightLogarithm)) continue;
    taps.shares[i] = kernel[abs(place.x)] * kernel[abs(place.y)] * by_normal;
    taps.distances[i] = distance;
  }
  // The pixel itself always counts in full.
  taps.shares[kTaps / 2] = kernel[0] * kernel[0];
  taps.distances[kTaps / 2] = 0.0;
  return taps;
}

float4 Mix(Taps taps, int2 pixel, float4 center, float deviation, int s) {
  const float luminance = Luminance(center.rgb);
  // Light that differs only by rounding is always mixed. The variance is a difference of squares,
  // so rounding alone makes it 1e-7 of the light's square.
  const float per_luminance =
      1.0 / (denoise.sigma_l * max(deviation, 1e-3 * luminance) + 1e-30);
  float weights = 0.0;
  float3 color = float3(0, 0, 0);
  float variance = 0.0;
  for (int i = 0; i < kTaps; ++i) {
    if (taps.shares[i] == 0.0) continue;
    const float4 tap = signal[s][pixel + TapOffset(i) * denoise.step];
    const float distance = taps.distances[i] + abs(Luminance(tap.rgb) - luminance) * per_luminance;
    const float weight = taps.shares[i] * exp(-distance);
    color += weight * tap.rgb;
    variance += weight * weight * tap.w;
    weights += weight;
  }
  return float4(color / weights, variance / (weights * weights));
}

// One pass of the a-trous wavelet filter, from signal to accumulated.
[shader("compute")]
[numthreads(8, 8, 1)]
void Atrous(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(guides);
  if (!IsInside(pixel, size)) return;
  if (guides[pixel].w == 0.0) {
    for (int i = 0; i < denoise.signals; ++i) accumulated[i][pixel] = signal[i][pixel];
    return;
  }
  const Taps taps = WeighTaps(LoadGuide(pixel, size), pixel, size);
  for (int s = 0; s < denoise.signals; ++s) {
    const float4 center = signal[s][pixel];
    const float deviation = sqrt(max(SmoothVariance(pixel, size, s), 0.0));
    // Zero variance means no noise; the weights would only admit equal light.
    accumulated[s][pixel] =
        deviation == 0.0 || IsExact(pixel, s) ? center : Mix(taps, pixel, center, deviation, s);
  }
}
