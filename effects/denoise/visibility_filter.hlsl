// SPDX-License-Identifier: MIT
// Denoises visibility. Its noise is in penumbras only, and how wide a penumbra is follows from the
// distance to the closest occluder; that limits how far the filters reach, in space and over time.
// Up to four scalar channels at once, each as it would come out alone. [Schied et al. 2017;
// Control; NRD: SIGMA]
#include "frame.hlsli"

static const int kMostChannels = 4;  // effects/denoise/visibility_denoiser.h

// Mirrors VisibilityConstants in effects/denoise/visibility_denoiser.h.
struct VisibilityConstants {
  float alpha;          // least weight of the new frame
  uint max_history;     // frames
  uint history_valid;   // 0: there is no previous frame
  float reach;          // deviation of the filter, in radii of the penumbra
  float clip;           // history that is off by more deviations is let go; 0: none is
  int channels;
  int channel;          // PrepareChannel: of the input
  int lights_channel;   // PrepareChannel: of the lights; -1: none
  int step;             // pixels between taps
  uint vertical;        // FilterLine: 0 rows, 1 columns
  uint changes;         // 4 bits for each channel: 1 + its channel of the changes; 0: not known
};
ConstantBuffer<VisibilityConstants> constants : register(b0, space3);

// The change of signals since the previous frame, four in each. [temporal_gradients.hlsl]
RWTexture2D<float4> changes[2] : register(u0, space3);

// Geometric normal and view depth; all zero where there is no surface.
RWTexture2D<float4> previous_guides : register(u2, space3);
RWTexture2D<float4> guides : register(u3, space3);

// This frame's samples. x: visibility, y: 1 / radius of the penumbra times the blocked part, z: the
// part that is blocked by what moves, w: the light.
RWTexture2D<float4> drawn[kMostChannels] : register(u4, space3);
// Accumulated over frames. x: visibility, y: frames, z: how much resampling has blurred it, the
// square of a deviation in pixels, w: the light.
RWTexture2D<float4> history[kMostChannels] : register(u8, space3);
// The same where the surfaces are now, and w: whether a shadow near them moved, 0 to 1.
RWTexture2D<float4> past[kMostChannels] : register(u12, space3);
RWTexture2D<float4> accumulated[kMostChannels] : register(u16, space3);
// Values of the neighbourhood. x: blocked part, y: 1 / radius times the blocked part, z: the part
// that is blocked by what moves, or was a few frames ago.
RWTexture2D<float4> blockers[kMostChannels] : register(u20, space3);
RWTexture2D<float4> filtered[kMostChannels] : register(u24, space3);

RWTexture2D<float4> source : register(u28, space3);
RWTexture2D<float4> sharpness : register(u29, space3);
RWTexture2D<uint2> lights_of_pixels : register(u30, space3);
RWTexture2D<float4> result : register(u31, space3);

int2 SizeOf(RWTexture2D<float4> picture) {
  uint width, height;
  picture.GetDimensions(width, height);
  return int2(width, height);
}

bool IsInside(int2 pixel, int2 size) { return all(pixel >= int2(0, 0)) && all(pixel < size); }

[shader("compute")]
[numthreads(8, 8, 1)]
void PrepareVisibilityGuides(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  if (!IsInside(pixel, SizeOf(guides))) return;
  const float z = g_view_z[pixel];
  // The direction that light comes from does not depend on a normal map.
  const float4 guide = float4(OctahedralDecode(g_normal[pixel]), z);
  const bool is_finite = all(isfinite(guide)) && all(isfinite(g_position[pixel]));
  guides[pixel] = z > 0.0 && is_finite ? guide : float4(0, 0, 0, 0);
}

// Metres that a pixel covers at this depth.
float Footprint(float view_z, int2 size) {
  return GrowthAt(view_z) * 2.0 * length(frame.camera_up) / float(size.y);
}

// A channel of the input, by itself.
[shader("compute")]
[numthreads(8, 8, 1)]
void PrepareChannel(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(guides);
  if (!IsInside(pixel, size)) return;
  const int channel = constants.channel;
  const float value = source[pixel][channel];
  // NaN is dark, so that it cannot spread.
  const float visibility = isfinite(value) ? saturate(value) : 0.0;
  const float blocked = 1.0 - visibility;
  // Sharper than a quarter of a pixel is as sharp as can be.
  const float sharpest = 4.0 / max(Footprint(guides[pixel].w, size), 1e-20);
  const float own = sharpness[pixel][channel];
  const float sharp = isfinite(own) ? clamp(own, 0.0, blocked * sharpest) : 0.0;
  const float moved = sharpness[pixel][channel + 2];
  float light = 0.0;
  if (constants.lights_channel >= 0) {
    light = float(lights_of_pixels[pixel][constants.lights_channel]);
  }
  result[pixel] = float4(visibility, sharp, moved > 0.0 ? blocked : 0.0, light);
}

// The surface at a pixel, and how much other pixels show of it.
struct Surface {
  float3 position;
  float3 normal;
  float footprint;
};

Surface SurfaceAt(int2 pixel, int2 size) {
  Surface surface;
  surface.position = g_position[pixel].xyz;
  surface.normal = guides[pixel].xyz;
  surface.footprint = Footprint(guides[pixel].w, size);
  return surface;
}

static const float kPlaneTolerance = 0.25;  // of a pixel
static const float kNoWeight = 1e-6;

// By distance from the surface's plane, which unlike a difference of depths is the same for floors
// seen at a grazing angle, and by geometric normals.
float SurfaceWeight(Surface surface, int2 other) {
  const float4 guide = guides[other];
  if (guide.w == 0.0) return 0.0;
  const float away = abs(dot(surface.normal, g_position[other].xyz - surface.position));
  const float cosine = saturate(dot(guide.xyz, surface.normal));
  const float squared = cosine * cosine;
  const float fourth = squared * squared;
  const float weight =
      fourth * fourth * exp(-away / (kPlaneTolerance * surface.footprint + 1e-20));
  return weight > kNoWeight ? weight : 0.0;
}

// Sums up the occluders of the neighbourhood, so that those pixels of a penumbra that all rays left
// know them too. From filtered to blockers.
[shader("compute")]
[numthreads(8, 8, 1)]
void SpreadBlockers(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(guides);
  if (!IsInside(pixel, size) || guides[pixel].w == 0.0) return;
  const Surface surface = SurfaceAt(pixel, size);
  float3 sums[kMostChannels];
  float weights[kMostChannels];
  float lights_here[kMostChannels];
  for (int s = 0; s < constants.channels; ++s) {
    sums[s] = float3(0, 0, 0);
    weights[s] = 0.0;
    lights_here[s] = drawn[s][pixel].w;
  }
  for (int y = -2; y <= 2; ++y) {
    for (int x = -2; x <= 2; ++x) {
      const int2 other = pixel + int2(x, y) * constants.step;
      if (!IsInside(other, size)) continue;
      const float weight = x == 0 && y == 0 ? 1.0 : SurfaceWeight(surface, other);
      if (weight == 0.0) continue;
      for (int s = 0; s < constants.channels; ++s) {
        const float4 tap = drawn[s][other];
        if (tap.w != lights_here[s]) continue;
        const float3 own = float3(1.0 - tap.x, tap.yz);
        sums[s] += weight * (constants.step == 1 ? own : filtered[s][other].xyz);
        weights[s] += weight;
      }
    }
  }
  for (int t = 0; t < constants.channels; ++t) {
    blockers[t][pixel] = float4(sums[t] / weights[t], 0);
  }
}

static const float kWidest = 1e6;  // pixels

// Radius of the penumbra in pixels. Where nothing is in the way, `otherwise`.
float PenumbraRadius(int s, int2 pixel, float footprint, float otherwise) {
  const float2 blocked = blockers[s][pixel].xy;
  if (!(blocked.x > 0.0) || !(blocked.y > 0.0)) return otherwise;
  return min(blocked.x / (blocked.y * footprint), kWidest);
}

// The place of a pixel's surface in the previous frame.
struct Before {
  int2 corner;        // of the four pixels around it
  float2 part;        // of a pixel, from there
  float weights[4];   // x runs fastest; 0: shows another surface
  bool is_whole;      // all of 4 x 4 pixels show the surface
};

bool ShowsSurface(int2 tap, int2 size, float4 guide, float expected_z, float tolerance) {
  if (!IsInside(tap, size)) return false;
  const float4 other = previous_guides[tap];
  return other.w != 0.0 && abs(other.w - expected_z) <= tolerance &&
         dot(other.xyz, guide.xyz) >= 0.9;
}

Before FindBefore(int2 pixel, int2 size, float4 guide) {
  Before before;
  before.corner = pixel;
  before.part = float2(0, 0);
  before.is_whole = false;
  for (int i = 0; i < 4; ++i) before.weights[i] = 0.0;
  const float4 motion = g_motion[pixel];
  if (constants.history_valid == 0 || guide.w == 0.0) return before;
  if (!isfinite(motion.x) || !isfinite(motion.y)) return before;
  float2 place = float2(pixel) + motion.xy * float2(size);
  // Far outside the picture, the conversion to integers would overflow.
  if (any(place < float2(-1, -1)) || any(place > float2(size))) return before;
  // A thousandth of a pixel is rounding, not motion.
  const float2 nearest = round(place);
  if (all(abs(place - nearest) < float2(1e-3, 1e-3))) place = nearest;
  const float2 corner = floor(place);
  before.corner = int2(corner);
  before.part = place - corner;
  // A plane's depth changes by this much per pixel; the previous view is nearly the same.
  const float cosine = abs(dot(guide.xyz, SeenAlong(g_position[pixel].xyz)));
  const float tolerance = 2.0 * Footprint(guide.w, size) / max(cosine, 0.05) + 0.005 * guide.w;
  before.is_whole = true;
  for (int j = 0; j < 16; ++j) {
    const int2 offset = int2(j & 3, j >> 2) - int2(1, 1);
    if (!ShowsSurface(before.corner + offset, size, guide, guide.w + motion.z, 2.0 * tolerance)) {
      before.is_whole = false;
      continue;
    }
    if (any(offset < int2(0, 0)) || any(offset > int2(1, 1))) continue;
    before.weights[offset.x + 2 * offset.y] =
        (offset.x == 1 ? before.part.x : 1.0 - before.part.x) *
        (offset.y == 1 ? before.part.y : 1.0 - before.part.y);
  }
  return before;
}

float4 CubicWeights(float t) {
  const float squared = t * t;
  const float cube = squared * t;
  return float4(-0.5 * t + squared - 0.5 * cube, 1.0 - 2.5 * squared + 1.5 * cube,
                0.5 * t + 2.0 * squared - 1.5 * cube, -0.5 * squared + 0.5 * cube);
}

// The history between 4 x 4 pixels by Catmull and Rom's curve, which blurs far less than a linear
// one. Negative: another light shone on one of them.
float SampleCubic(Before before, int s, float light) {
  const float4 across = CubicWeights(before.part.x);
  const float4 down = CubicWeights(before.part.y);
  float sum = 0.0;
  for (int j = 0; j < 16; ++j) {
    const int x = j & 3;
    const int y = j >> 2;
    const float4 tap = history[s][before.corner + int2(x - 1, y - 1)];
    if (tap.w != light || !(tap.y >= 1.0) || !all(isfinite(tap))) return -1.0;
    sum += across[x] * down[y] * tap.x;
  }
  return saturate(sum);
}

// Blur by a cubic curve as a part of that by a linear one, in a penumbra of this radius in pixels.
// Its error is of the fourth order, so wide penumbras hardly have any.
float CubicBlur(float radius) { return clamp(0.06 / (radius * radius), 0.02, 1.0); }

// Brings the history to where the surfaces are now: into past, with no frames where a surface was
// not visible or was lit by another light.
[shader("compute")]
[numthreads(8, 8, 1)]
void ReprojectVisibility(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(guides);
  if (!IsInside(pixel, size)) return;
  const Before before = FindBefore(pixel, size, guides[pixel]);
  const float2 spread = before.part * (float2(1, 1) - before.part);
  const float linear_blur = 0.5 * (spread.x + spread.y);
  const uint instance = g_ids[pixel].x;
  const bool moves = instance != 0 && previous_instances[instance - 1].flags != 0;
  for (int s = 0; s < constants.channels; ++s) {
    past[s][pixel] = float4(0, 0, 0, 0);
    const float light = drawn[s][pixel].w;
    float4 sum = float4(0, 0, 0, 0);
    float weight = 0.0;
    float moved = moves ? 1.0 : blockers[s][pixel].z;
    for (int k = 0; k < 4; ++k) {
      if (before.weights[k] == 0.0) continue;
      const int2 place = before.corner + int2(k & 1, k >> 1);
      const float4 tap = history[s][place];
      // A NaN in the history would never go away.
      if (tap.w != light || !(tap.y >= 1.0) || !all(isfinite(tap))) continue;
      // In this picture of the previous frame.
      moved = max(moved, filtered[s][place].z);
      sum += before.weights[k] * tap;
      weight += before.weights[k];
    }
    // A hundredth of a pixel is rounding error, not history.
    if (weight < 0.01) continue;
    sum /= weight;
    float blur = linear_blur;
    if (before.is_whole && linear_blur > 0.0) {
      const float cubic = SampleCubic(before, s, light);
      if (cubic >= 0.0) {
        sum.x = cubic;
        blur *= CubicBlur(PenumbraRadius(s, pixel, Footprint(guides[pixel].w, size), kWidest));
      }
    }
    past[s][pixel] = float4(saturate(sum.x), min(sum.y, float(constants.max_history)),
                            sum.z + blur, saturate(moved));
  }
}

// OutdatedPart returns how much of the history is outdated, 0 to 1: whether new and old visibility
// differ by more than noise explains, in the mean of 7 x 7 pixels. Where something moves, in the
// mean over a penumbra, which for sharp shadows is the pixel alone. Differences pixel by pixel hold
// no structure of the picture, so a shadow that stays where it is does not count.
static const float kClipOfMoving = 0.15;

float OutdatedPart(int s, int2 pixel, int2 size, Surface surface, float radius) {
  const bool moves = past[s][pixel].w > 0.0;
  const float over_width = moves ? 0.5 / clamp(radius * radius, 0.1, 9.0) : 0.0;
  const float light = drawn[s][pixel].w;
  const float frames = past[s][pixel].y;
  float weights = 0.0;
  float squared_weights = 0.0;
  float before_sum = 0.0;
  float now_sum = 0.0;
  for (int y = -3; y <= 3; ++y) {
    for (int x = -3; x <= 3; ++x) {
      const int2 other = pixel + int2(x, y);
      if (!IsInside(other, size)) continue;
      const float4 before = past[s][other];
      const float4 now = drawn[s][other];
      if (before.y == 0.0 || now.w != light) continue;
      float weight = exp(-float(x * x + y * y) * over_width);
      if (x != 0 || y != 0) weight *= SurfaceWeight(surface, other);
      weights += weight;
      squared_weights += weight * weight;
      before_sum += weight * before.x;
      now_sum += weight * now.x;
    }
  }
  const float pixels = weights * weights / squared_weights;
  const float before = before_sum / weights;
  const float now = now_sum / weights;
  // Visibility that few rays have seen is not certain; but the narrower the penumbra, the more
  // pixels are either lit or dark. A beta distribution says so before the first ray.
  const float prior = moves ? clamp(0.25 * radius * radius, 0.01, 0.5) : 0.5;
  const float rays = pixels * frames;
  const float p = (before * rays + prior) / (rays + 2.0 * prior);
  float deviation = sqrt(p * (1.0 - p) * (1.0 / pixels + 1.0 / rays));
  // Half lit where nothing is: that is a shadow that has gone on, not noise.
  if (moves) deviation *= clamp(radius, 0.1, 1.0);
  // There a shadow that trails is worse than noise.
  const float allowed = moves ? kClipOfMoving * constants.clip : constants.clip;
  return saturate(abs(now - before) / deviation - allowed);
}

// 0: visibility is as it was; 1: nothing of it is. [Schied et al. 2018]
float ChangeOf(int2 pixel, int s) {
  const uint channel = constants.changes >> (4 * s) & 15u;
  if (channel == 0) return 0.0;
  return changes[(channel - 1) / 4][pixel][(channel - 1) % 4];
}

static const float kMemory = 0.5;       // of what moved, from frame to frame
static const float kForgotten = 1e-3;

[shader("compute")]
[numthreads(8, 8, 1)]
void AccumulateVisibility(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(guides);
  if (!IsInside(pixel, size)) return;
  const Surface surface = SurfaceAt(pixel, size);
  for (int s = 0; s < constants.channels; ++s) {
    const float4 now = drawn[s][pixel];
    const float4 before = past[s][pixel];
    // A shadow that has gone on stays in mind until nothing of it is left in the history.
    const float fading = kMemory * before.w;
    if (fading > kForgotten) blockers[s][pixel].z = max(blockers[s][pixel].z, fading);
    if (before.y == 0.0) {
      accumulated[s][pixel] = float4(now.x, 1.0, 0.0, now.w);
      continue;
    }
    float alpha = max(constants.alpha, 1.0 / (before.y + 1.0));
    const float radius = PenumbraRadius(s, pixel, surface.footprint, kWidest);
    if (constants.clip > 0.0) {
      // Where something moved and nothing is in the way any more, no penumbra is left.
      const float tested = before.w > 0.0 && radius == kWidest ? 0.0 : radius;
      alpha = max(alpha, OutdatedPart(s, pixel, size, surface, tested));
    }
    alpha = max(alpha, ChangeOf(pixel, s));
    // Resampling must not blur more than the filter may.
    const float allowed = constants.reach * constants.reach * radius * radius;
    if ((1.0 - alpha) * before.z > allowed) alpha = 1.0 - allowed / before.z;
    const float frames = min(min(before.y + 1.0, 1.0 / max(alpha, 1e-6)),
                             float(constants.max_history));
    accumulated[s][pixel] =
        float4(lerp(before.x, now.x, alpha), frames, (1.0 - alpha) * before.z, now.w);
  }
}

// The square of the deviation, in pixels, to which a channel may still be blurred. More samples
// leave less noise, which a narrower filter removes with less bias: with n times the samples the
// least error is at n^(-1/6) of the width.
float AllowedBlur(int s, int2 pixel, float footprint, float4 own) {
  // Where no shadow is near, the filter would only fetch one from afar.
  const float deviation = constants.reach * PenumbraRadius(s, pixel, footprint, 0.0);
  return deviation * deviation / pow(max(own.y, 1.0), 1.0 / 3.0) - own.z;
}

static const float kLeastBlur = 0.02;  // less does nothing

// One pass of a wavelet filter, 5 x 5 taps `step` pixels apart, from accumulated to filtered. Each
// pass blurs by at most step pixels, and all together by what is allowed: nothing at all where the
// penumbra is narrower than a pixel.
[shader("compute")]
[numthreads(8, 8, 1)]
void FilterVisibility(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(guides);
  if (!IsInside(pixel, size)) return;
  const Surface surface = SurfaceAt(pixel, size);
  const float most = float(constants.step * constants.step);
  const float done = (most - 1.0) / 3.0;  // by the passes before: 1 + 4 + 16 + ...
  float over_blur[kMostChannels];  // 1 / (2 square of this pass's deviation, metres); 0: no filter
  float4 own[kMostChannels];
  float sums[kMostChannels];
  float weights[kMostChannels];
  bool any_left = false;
  for (int s = 0; s < constants.channels; ++s) {
    own[s] = accumulated[s][pixel];
    sums[s] = own[s].x;
    weights[s] = 1.0;
    over_blur[s] = 0.0;
    if (guides[pixel].w == 0.0) continue;
    const float left = min(AllowedBlur(s, pixel, surface.footprint, own[s]) - done, most);
    if (left < kLeastBlur * most) continue;
    over_blur[s] = 0.5 / (left * surface.footprint * surface.footprint);
    any_left = true;
  }
  for (int i = 0; i < 25 && any_left; ++i) {
    if (i == 12) continue;
    const int2 other = pixel + int2(i % 5 - 2, i / 5 - 2) * constants.step;
    if (!IsInside(other, size)) continue;
    const float share = SurfaceWeight(surface, other);
    if (share == 0.0) continue;
    const float3 away = g_position[other].xyz - surface.position;
    const float squared = dot(away, away);
    for (int t = 0; t < constants.channels; ++t) {
      if (over_blur[t] == 0.0) continue;
      const float4 tap = accumulated[t][other];
      if (tap.w != own[t].w) continue;
      const float weight = share * exp(-squared * over_blur[t]);
      sums[t] += weight * tap.x;
      weights[t] += weight;
    }
  }
  for (int t = 0; t < constants.channels; ++t) {
    filtered[t][pixel] = float4(sums[t] / weights[t], own[t].yzw);
  }
}

static const int kLineTaps = 8;  // to each side

// One row or column of Control's filter, from accumulated to filtered, for half of what is allowed:
// it runs twice. [Control]
[shader("compute")]
[numthreads(8, 8, 1)]
void FilterLine(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(guides);
  if (!IsInside(pixel, size)) return;
  const Surface surface = SurfaceAt(pixel, size);
  const int2 direction = constants.vertical != 0 ? int2(0, 1) : int2(1, 0);
  for (int s = 0; s < constants.channels; ++s) {
    const float4 own = accumulated[s][pixel];
    float blur = 0.0;
    if (guides[pixel].w != 0.0) blur = 0.5 * AllowedBlur(s, pixel, surface.footprint, own);
    // Two deviations are covered, by taps at most two pixels apart.
    blur = min(blur, float(kLineTaps * kLineTaps));
    if (!(blur >= kLeastBlur)) {
      filtered[s][pixel] = own;
      continue;
    }
    const float spacing = max(2.0 * sqrt(blur) / float(kLineTaps), 1.0);
    const float over_blur = 0.5 / (blur * surface.footprint * surface.footprint);
    float sum = own.x;
    float weights = 1.0;
    for (int i = -kLineTaps; i <= kLineTaps; ++i) {
      const int2 other = pixel + int(round(float(i) * spacing)) * direction;
      if (i == 0 || !IsInside(other, size)) continue;
      const float4 tap = accumulated[s][other];
      if (tap.w != own.w) continue;
      const float3 away = g_position[other].xyz - surface.position;
      const float weight =
          SurfaceWeight(surface, other) * exp(-dot(away, away) * over_blur);
      if (!(weight > kNoWeight)) continue;
      sum += weight * tap.x;
      weights += weight;
    }
    filtered[s][pixel] = float4(sum / weights, own.yzw);
  }
}

// Puts one channel, or two that belong together, into the picture that others read.
[shader("compute")]
[numthreads(8, 8, 1)]
void WriteVisibility(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  if (!IsInside(pixel, SizeOf(result))) return;
  const float first = accumulated[0][pixel].x;
  if (constants.channels == 1) {
    result[pixel] = float4(first, first, first, 0);
  } else {
    result[pixel] = float4(first, accumulated[1][pixel].x, 0, 0);
  }
}
