// SPDX-License-Identifier: MIT
// Shadow maps that can be filtered before they are looked up: each stores functions of the depth
// whose mean over a filter still says which share of it is nearer to the sun than the surface. A
// pass turns depths into these, two blur them along rows and columns, and a lookup of one place
// gives visibility. [survey 5.1.3, 5.1.4]

// Mirrors the members of FilteredShadowMapConstants of filtered_shadow_map.h behind `map`.
struct FilterConstants {
  float exponent;
  float back_exponent;
  uint terms;
  float damping;
  float reduce_bleeding;
  float least_variance;
  float offset;
  uint level;  // of PCSS's levels: the one that is made
};
#define KAAMOS_SHADOW_MAP_MORE FilterConstants

#include "../shadow_map/shadow_map.hlsli"

// FilteredShadowMapMethod
static const uint kVariance = 0;
static const uint kExponential = 1;
static const uint kExponentialVariance = 2;
static const uint kFourier = 3;
static const uint kPcssVariance = 4;
static const uint kPcssFourier = 5;

static const uint kMostLevels = 15;
static const int kWidestFilter = 128;  // texels to each side

// The stored maps, a slice for each map; a Fourier series has a slice for every two terms. For PCSS
// the series times the depth follows, and the depth. The second picture is between rows and columns.
Texture2DArray<float4> stored : register(t5, space3);
Texture2DArray<float4> half_filtered : register(t6, space3);
RWTexture2DArray<float4> half_filtered_out : register(u1, space3);
RWTexture2DArray<float4> levels[kMostLevels] : register(u2, space3);  // of what is stored

uint SeriesSlices() { return (constants.more.terms + 1) / 2; }

uint SliceCount() {
  if (constants.method == kPcssFourier) return 2 * SeriesSlices() + 1;
  return constants.method == kFourier ? SeriesSlices() : 1;
}

// Frequency of a term of the series of a step: odd multiples of half a period.
float Frequency(uint term) { return 3.14159265 * (2.0 * float(term) + 1.0); }

// sin and cos of two terms of the series.
float4 Series(float share, uint slice) {
  const float first = Frequency(2 * slice) * share;
  const float second = Frequency(2 * slice + 1) * share;
  return float4(sin(first), cos(first), sin(second), cos(second));
}

// Returns what the maps hold for a share of the range, 0 to 1, which changes by `change` per texel.
float4 Store(float share, float2 change, uint slice) {
  if (constants.method == kExponential) {
    return float4(exp(constants.more.exponent * share), 0, 0, 0);
  }
  const float depth = 2.0 * share - 1.0;
  if (constants.method == kExponentialVariance) {
    const float front = exp(constants.more.exponent * depth);
    const float back = -exp(-constants.more.back_exponent * depth);
    return float4(front, front * front, back, back * back);
  }
  if (constants.method == kFourier) return 0.5 + 0.5 * Series(share, slice);
  if (constants.method == kPcssFourier) {
    const uint series = SeriesSlices();
    if (slice < series) return Series(share, slice);
    if (slice < 2 * series) return share * Series(share, slice - series);
    return float4(share, 0, 0, 0);
  }
  // The second moment over a texel: a slope across it is variance, too. A quarter of the squares, but
  // `depth` changes by twice as much as shares do.
  return float4(depth, depth * depth + dot(change, change), 0, 0);
}

uint LevelSize(uint level) { return max(constants.size >> level, 1u); }

// The nearest texel of the map, as a sampler that clamps.
int2 Clamped(int2 texel, uint level) {
  const int last = int(LevelSize(level)) - 1;
  return clamp(texel, int2(0, 0), int2(last, last));
}

float Share(int2 texel, uint map) {
  return shadow_depth[uint3(uint2(Clamped(texel, 0)), map)];
}

// Returns the one of two one-sided differences that does not cross an edge.
float Smaller(float a, float b) { return abs(a) < abs(b) ? a : b; }

[shader("compute")]
[numthreads(8, 8, 1)]
void StoreMap(uint3 id : SV_DispatchThreadID) {
  const int2 texel = int2(id.xy);
  if (!IsInMap(texel)) return;
  const float share = Share(texel, constants.map);
  const float2 change =
      float2(Smaller(Share(texel + int2(1, 0), constants.map) - share,
                     share - Share(texel - int2(1, 0), constants.map)),
             Smaller(Share(texel + int2(0, 1), constants.map) - share,
                     share - Share(texel - int2(0, 1), constants.map)));
  const uint slices = SliceCount();
  for (uint slice = 0; slice < slices; ++slice) {
    levels[0][uint3(id.xy, constants.map * slices + slice)] = Store(share, change, slice);
  }
}

// Half the width of the box that maps are filtered with, in texels; its ends cut through texels.
float FilterRadius() {
  return clamp(constants.radius / maps[constants.map].texel, 0.5, float(kWidestFilter));
}

// Returns how much of the texel `away` from the middle one lies in the box, over the box's width.
float FilterWeight(int away, float radius) {
  const float covered = min(radius, abs(float(away)) + 0.5) - max(-radius, abs(float(away)) - 0.5);
  return saturate(covered) / (2.0 * radius);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void FilterRows(uint3 id : SV_DispatchThreadID) {
  const int2 texel = int2(id.xy);
  if (!IsInMap(texel)) return;
  const float radius = FilterRadius();
  const int reach = int(ceil(radius - 0.5));
  const uint slices = SliceCount();
  for (uint i = 0; i < slices; ++i) {
    const uint slice = constants.map * slices + i;
    float4 sum = float4(0, 0, 0, 0);
    for (int away = -reach; away <= reach; ++away) {
      const int2 tap = Clamped(texel + int2(away, 0), 0);
      sum += FilterWeight(away, radius) * stored.Load(int4(tap, slice, 0));
    }
    half_filtered_out[uint3(id.xy, slice)] = sum;
  }
}

[shader("compute")]
[numthreads(8, 8, 1)]
void FilterColumns(uint3 id : SV_DispatchThreadID) {
  const int2 texel = int2(id.xy);
  if (!IsInMap(texel)) return;
  const float radius = FilterRadius();
  const int reach = int(ceil(radius - 0.5));
  const uint slices = SliceCount();
  for (uint i = 0; i < slices; ++i) {
    const uint slice = constants.map * slices + i;
    float4 sum = float4(0, 0, 0, 0);
    for (int away = -reach; away <= reach; ++away) {
      const int2 tap = Clamped(texel + int2(0, away), 0);
      sum += FilterWeight(away, radius) * half_filtered.Load(int4(tap, slice, 0));
    }
    levels[0][uint3(id.xy, slice)] = sum;
  }
}

// A level of half the size: the mean of four texels of the one before. Sizes are powers of two.
[shader("compute")]
[numthreads(8, 8, 1)]
void HalveLevel(uint3 id : SV_DispatchThreadID) {
  const uint level = constants.more.level;
  if (any(id.xy >= LevelSize(level))) return;
  const uint slices = SliceCount();
  for (uint slice = constants.map * slices; slice < (constants.map + 1) * slices; ++slice) {
    float4 sum = float4(0, 0, 0, 0);
    for (uint i = 0; i < 4; ++i) {
      sum += levels[level - 1][uint3(2 * id.xy + uint2(i & 1, i >> 1), slice)];
    }
    levels[level][uint3(id.xy, slice)] = 0.25 * sum;
  }
}

float4 StoredAt(int2 texel, uint slice, uint level) {
  return stored.Load(int4(Clamped(texel, level), slice, level));
}

// Between four texels of a level. `at` in texels of level 0.
float4 Interpolated(float2 at, uint slice, uint level) {
  const float2 place = at / float(1u << level) - 0.5;
  const float2 corner = floor(place);
  const float2 part = place - corner;
  const int2 texel = int2(corner);
  const float4 upper = lerp(StoredAt(texel, slice, level),
                            StoredAt(texel + int2(1, 0), slice, level), part.x);
  const float4 lower = lerp(StoredAt(texel + int2(0, 1), slice, level),
                            StoredAt(texel + int2(1, 1), slice, level), part.x);
  return lerp(upper, lower, part.y);
}

// Where there is no map nothing casts a shadow.
bool IsOutside(Receiver receiver) { return !IsInMap(int2(floor(receiver.at))); }

// Share of the range at which the surface is taken to be.
float ReceiverShare(Receiver receiver) {
  return saturate((receiver.depth - receiver.bias) / maps[receiver.map].range);
}

// No more than this share of a distribution lies at or beyond `value`: what is lit. Where the mean
// does, nothing is said, and all of it is taken to be lit. [Donnelly & Lauritzen 2006]
float Chebyshev(float2 moments, float value, float least_variance) {
  if (value <= moments.x) return 1.0;
  const float variance = max(moments.y - moments.x * moments.x, least_variance);
  const float away = value - moments.x;
  return variance / (variance + away * away);
}

// Cuts off the light that bleeds in, and as much of each penumbra.
float ReduceBleeding(float lit) {
  const float cut = constants.more.reduce_bleeding;
  return saturate((lit - cut) / (1.0 - cut));
}

// least_variance is of shares, and depths go from -1 to 1.
float LeastVariance() { return 4.0 * constants.more.least_variance; }

float Variance(Receiver receiver, Surface surface) {
  if (IsOutside(receiver)) return 1.0;
  const float2 moments = Interpolated(receiver.at, receiver.map, 0).xy;
  return ReduceBleeding(Chebyshev(moments, 2.0 * ReceiverShare(receiver) - 1.0, LeastVariance()));
}

// As if the filtered comparisons were exp(c (occluder - receiver)): 0 far behind the occluder, and
// more than there is within some 1 / c of it. [Annen et al. 2008]
float Exponential(Receiver receiver, Surface surface) {
  if (IsOutside(receiver)) return 1.0;
  const float mean = Interpolated(receiver.at, receiver.map, 0).x;
  return saturate(exp(-constants.more.exponent * ReceiverShare(receiver)) * mean);
}

// Variance of depths that are warped so that what lies far in front of the surface weighs little;
// the second warp does the same from behind. Both are bounds. [Lauritzen & McCool 2008]
float ExponentialVariance(Receiver receiver, Surface surface) {
  if (IsOutside(receiver)) return 1.0;
  const float4 moments = Interpolated(receiver.at, receiver.map, 0);
  const float depth = 2.0 * ReceiverShare(receiver) - 1.0;
  const float front = exp(constants.more.exponent * depth);
  const float back = exp(-constants.more.back_exponent * depth);
  // A small step of depth is this large a step of warped depth.
  const float front_step = constants.more.exponent * front;
  const float back_step = constants.more.back_exponent * back;
  const float least = LeastVariance();
  const float lit = min(Chebyshev(moments.xy, front, least * front_step * front_step),
                        Chebyshev(moments.zw, -back, least * back_step * back_step));
  return ReduceBleeding(lit);
}

// Weight of a term of the step. The higher ones are damped, else it rings. [Annen et al. 2007]
float TermWeight(uint term) {
  const float part = float(term + 1) / float(constants.more.terms);
  return 2.0 / Frequency(term) * exp(-constants.more.damping * part * part);
}

// The series of a step, for an occluder `away` behind the surface.
float Step(float away) {
  float sum = 0.5;
  for (uint i = 0; i < constants.more.terms; ++i) sum += TermWeight(i) * sin(Frequency(i) * away);
  return sum;
}

// sin(c (z - d)) of the occluder z and the surface d is sin(c z) cos(c d) - cos(c z) sin(c d), and
// what has z in it is filtered. The step is a half where both are the same: surfaces move by a part
// of its width towards the sun, and what they then get when nothing stands before them counts as 1.
float Convolution(Receiver receiver, Surface surface) {
  if (IsOutside(receiver)) return 1.0;
  const float offset = constants.more.offset / (2.0 * float(constants.more.terms));
  const float share = ReceiverShare(receiver) - offset;
  const uint slices = SliceCount();
  float sum = 0.5;
  for (uint i = 0; i < slices; ++i) {
    const float4 mean = 2.0 * Interpolated(receiver.at, receiver.map * slices + i, 0) - 1.0;
    for (uint j = 0; j < 2 && 2 * i + j < constants.more.terms; ++j) {
      const float2 sin_cos = j == 0 ? mean.xy : mean.zw;
      const float angle = Frequency(2 * i + j) * share;
      sum += TermWeight(2 * i + j) * (sin_cos.x * cos(angle) - sin_cos.y * sin(angle));
    }
  }
  return saturate(sum / Step(offset));
}

// The mean of a slice over a disk of `radius` texels: between the two levels whose texels,
// interpolated, have nearest to its variance along each axis.
float4 MeanOver(Receiver receiver, uint slice, float radius) {
  const uint last = firstbithigh(constants.size);
  const float level = clamp(log2(max(radius, 1.0)), 0.0, float(last));
  const uint below = uint(level);
  const float4 fine = Interpolated(receiver.at, slice, below);
  const float4 coarse = Interpolated(receiver.at, slice, min(below + 1, last));
  return lerp(fine, coarse, level - float(below));
}

float2 MomentsOver(Receiver receiver, float radius) {
  return MeanOver(receiver, receiver.map, radius).xy;
}

// PCSS with both of its filters done beforehand. Of all in the search's disk the lit share is taken
// to be as deep as the surface, and what is then left over is the mean of what casts the shadow.
// [Fernando 2005; Yang et al. 2010]
float PcssVariance(Receiver receiver, Surface surface) {
  if (IsOutside(receiver)) return 1.0;
  const ShadowMap map = maps[receiver.map];
  const float most = constants.radius;
  const float search = min(frame.tan_sun_radius * max(receiver.depth, 0.0), most) / map.texel;
  // A sun that is a point.
  if (!(search > 0.0)) return IsLit(receiver, int2(floor(receiver.at)));
  const float depth = 2.0 * ReceiverShare(receiver) - 1.0;
  const float2 around = MomentsOver(receiver, search);
  const float open = Chebyshev(around, depth, LeastVariance());
  if (open >= 1.0) return 1.0;
  const float blocker = (around.x - open * depth) / (1.0 - open);
  const float gap = 0.5 * map.range * max(depth - blocker, 0.0);
  const float penumbra = min(frame.tan_sun_radius * gap, most) / map.texel;
  return ReduceBleeding(Chebyshev(MomentsOver(receiver, penumbra), depth, LeastVariance()));
}

// The mean over a disk of the series of the step, for a surface at `share`, from slice `first` on;
// without its constant term.
float SeriesOver(Receiver receiver, uint first, float share, float radius) {
  float sum = 0.0;
  for (uint i = 0; i < SeriesSlices(); ++i) {
    const float4 mean = MeanOver(receiver, first + i, radius);
    for (uint j = 0; j < 2 && 2 * i + j < constants.more.terms; ++j) {
      const float2 sin_cos = j == 0 ? mean.xy : mean.zw;
      const float angle = Frequency(2 * i + j) * share;
      sum += TermWeight(2 * i + j) * (sin_cos.x * cos(angle) - sin_cos.y * sin(angle));
    }
  }
  return sum;
}

// PCSS with both of its filters done beforehand, by a series of the step: what it says of the depths
// that are nearer to the sun, times these depths, is filtered as it is itself, and the one over the
// other is their mean. [Annen et al. 2008b]
float PcssConvolution(Receiver receiver, Surface surface) {
  if (IsOutside(receiver)) return 1.0;
  const ShadowMap map = maps[receiver.map];
  const float most = constants.radius;
  const float search = min(frame.tan_sun_radius * max(receiver.depth, 0.0), most) / map.texel;
  // A sun that is a point.
  if (!(search > 0.0)) return IsLit(receiver, int2(floor(receiver.at)));
  const uint series = SeriesSlices();
  const uint first = receiver.map * SliceCount();
  const float offset = constants.more.offset / (2.0 * float(constants.more.terms));
  const float surface_share = ReceiverShare(receiver);
  const float share = surface_share - offset;
  const float whole = Step(offset);
  const float dark = 1.0 - saturate((0.5 + SeriesOver(receiver, first, share, search)) / whole);
  // Less of it is what rings.
  if (dark < 0.01) return 1.0;
  const float depth = MeanOver(receiver, first + 2 * series, search).x;
  const float lit_depth =
      (0.5 * depth + SeriesOver(receiver, first + series, share, search)) / whole;
  const float blocker = clamp((depth - lit_depth) / dark, 0.0, surface_share);
  const float gap = map.range * (surface_share - blocker);
  const float penumbra = min(frame.tan_sun_radius * gap, most) / map.texel;
  return saturate((0.5 + SeriesOver(receiver, first, share, penumbra)) / whole);
}

KAAMOS_SHADOW_LOOKUP(LookUpVariance, Variance)
KAAMOS_SHADOW_LOOKUP(LookUpExponential, Exponential)
KAAMOS_SHADOW_LOOKUP(LookUpExponentialVariance, ExponentialVariance)
KAAMOS_SHADOW_LOOKUP(LookUpConvolution, Convolution)
KAAMOS_SHADOW_LOOKUP(LookUpPcssVariance, PcssVariance)
KAAMOS_SHADOW_LOOKUP(LookUpPcssConvolution, PcssConvolution)
