// SPDX-License-Identifier: MIT
// Adaptive ray traced shadows: rays go where the visibility of a light varied in the last frames,
// and frames and neighbours are averaged. [Boksansky, Wimmer & Bittner 2019]
#include "sampling.hlsli"
#include "visibility.hlsli"

RWTexture2D<float4> result : register(u0, space3);   // x: visibility
RWTexture2D<float4> sampled : register(u1, space3);  // x: rays of the pixel, y: its variation,
                                                     // z: that for the filter
// These hold the last four frames, the newest in x: `before` as the frame before left them, `now`
// carried along with the surfaces.
RWTexture2D<float4> visibility_before : register(u2, space3);
RWTexture2D<float4> visibility_now : register(u3, space3);
RWTexture2D<float4> variation_before : register(u4, space3);  // unfiltered
RWTexture2D<float4> variation_now : register(u5, space3);
RWTexture2D<float4> counts_before : register(u6, space3);
RWTexture2D<float4> counts_now : register(u7, space3);
RWTexture2D<float> view_z_before : register(u8, space3);
// Between two passes. The first one ends up with the filtered variation.
RWTexture2D<float4> work : register(u9, space3);   // x: variation, y: 1 where history was found
RWTexture2D<float4> other : register(u10, space3);
RWStructuredBuffer<float> sums : register(u11, space3);  // of variation by tile; last: the mean

// Mirrors AdaptiveShadowConstants in effects/shadows/adaptive_shadow/adaptive_shadow.h.
struct AdaptiveShadowConstants {
  float target;           // variation that is left alone
  float facing_depth;     // relative change of depth that is still the same surface, seen from
  float grazing_depth;    // the front and along it
  float filter_variation; // from which on neighbours are averaged as widely as possible
  float budget;           // mean variation from which on rays are cut; 0: never
  uint flags;
  uint light;             // kSun, or a local light
  uint frame_count;       // frames before this one
};
ConstantBuffer<AdaptiveShadowConstants> constants : register(b0, space3);

static const uint kReleasedHistory = 1;
static const uint kReleasedShift = 2;
static const uint kReleasedLowPass = 4;
static const uint kUniform = 8;
static const uint kUnfiltered = 16;
static const uint kSun = 0xFFFFFFFF;

bool Has(uint flag) { return (constants.flags & flag) != 0; }

// Returns the relative difference that the depths of two places of one surface may have: more where
// it is seen along itself.
float DepthTolerance(float3 normal) {
  return lerp(constants.grazing_depth, constants.facing_depth,
              saturate(abs(dot(normal, frame.camera_forward))));
}

bool IsSameDepth(float z, float other_z, float tolerance) {
  return other_z > 0.0 && abs(1.0 - z / other_z) < tolerance;
}

float Range(float4 v) {
  return max(max(v.x, v.y), max(v.z, v.w)) - min(min(v.x, v.y), min(v.z, v.w));
}

float Mean(float4 v) { return 0.25 * (v.x + v.y + v.z + v.w); }

// Returns where the pixel's surface was in the frame before; x < 0: not in its picture, or hidden.
int2 PixelBefore(int2 pixel, int2 size) {
  if (constants.frame_count == 0 || g_ids[pixel].x == 0) return int2(-1, -1);
  const float4 motion = g_motion[pixel];
  const float2 at = float2(pixel) + 0.5 + motion.xy * float2(size);
  // False for what is no number.
  if (!(all(at >= float2(0, 0)) && all(at < float2(size)))) return int2(-1, -1);
  const int2 before = int2(at);
  const float tolerance = DepthTolerance(OctahedralDecode(g_normal[pixel]));
  const bool same = IsSameDepth(g_view_z[pixel] + motion.z, view_z_before[before], tolerance);
  return same ? before : int2(-1, -1);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void Reproject(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  result.GetDimensions(width, height);
  const int2 size = int2(width, height), pixel = int2(id.xy);
  if (any(pixel >= size)) return;
  const int2 before = PixelBefore(pixel, size);
  const bool found = before.x >= 0;
  float4 visibility = float4(0, 0, 0, 0), variation = float4(0, 0, 0, 0);
  float4 counts = float4(0, 0, 0, 0);
  if (found) {
    visibility = visibility_before[before];
    variation = variation_before[before];
    counts = counts_before[before];
  }
  visibility_now[pixel] = visibility;
  variation_now[pixel] = variation;
  counts_now[pixel] = counts;
  const float range = Has(kReleasedHistory) ? variation.x : Range(visibility);
  work[pixel] = float4(range, found ? 1.0 : 0.0, range, 0.0);
}

// Variation spreads: the largest of 5 x 5 pixels, then a low pass of 13 x 13, each in two passes.
static const int kMaxReach = 2;
static const int kTentReach = 6;
static const int kBoxReach = 4;

float Largest(RWTexture2D<float4> picture, int2 pixel, int2 step, int2 size) {
  float most = 0.0;
  for (int i = -kMaxReach; i <= kMaxReach; ++i) {
    most = max(most, picture[clamp(pixel + i * step, int2(0, 0), size - 1)].x);
  }
  return most;
}

float LowPass(RWTexture2D<float4> picture, int2 pixel, int2 step, int2 size) {
  const bool is_box = Has(kReleasedLowPass);
  const int reach = is_box ? kBoxReach : kTentReach;
  float sum = 0.0, weights = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    const float weight = is_box ? 1.0 : float(kTentReach + 1 - abs(i));
    sum += weight * picture[clamp(pixel + i * step, int2(0, 0), size - 1)].x;
    weights += weight;
  }
  return sum / weights;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void MaxAcross(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  result.GetDimensions(width, height);
  const int2 size = int2(width, height), pixel = int2(id.xy);
  if (any(pixel >= size)) return;
  other[pixel] = float4(Largest(work, pixel, int2(1, 0), size), work[pixel].yzw);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void MaxDown(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  result.GetDimensions(width, height);
  const int2 size = int2(width, height), pixel = int2(id.xy);
  if (any(pixel >= size)) return;
  work[pixel] = float4(Largest(other, pixel, int2(0, 1), size), other[pixel].yzw);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void LowPassAcross(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  result.GetDimensions(width, height);
  const int2 size = int2(width, height), pixel = int2(id.xy);
  if (any(pixel >= size)) return;
  other[pixel] = float4(LowPass(work, pixel, int2(1, 0), size), work[pixel].yzw);
}

// And joins the filtered variation with that of the four frames before.
[shader("compute")]
[numthreads(8, 8, 1)]
void LowPassDown(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  result.GetDimensions(width, height);
  const int2 size = int2(width, height), pixel = int2(id.xy);
  if (any(pixel >= size)) return;
  const float filtered = LowPass(other, pixel, int2(0, 1), size);
  work[pixel] = float4(0.5 * (filtered + Mean(variation_now[pixel])), other[pixel].yzw);
}

static const uint kTile = 64;  // pixels along a side; a thread adds up 8 x 8 of them

groupshared float g_sums[64];

[shader("compute")]
[numthreads(8, 8, 1)]
void SumTiles(uint3 group : SV_GroupID, uint3 within : SV_GroupThreadID,
              uint thread : SV_GroupIndex) {
  uint width, height;
  result.GetDimensions(width, height);
  const uint2 corner = group.xy * kTile + within.xy * 8;
  float sum = 0.0;
  for (uint i = 0; i < 64; ++i) {
    const uint2 pixel = corner + uint2(i & 7, i >> 3);
    if (all(pixel < uint2(width, height))) sum += work[pixel].x;
  }
  g_sums[thread] = sum;
  GroupMemoryBarrierWithGroupSync();
  if (thread != 0) return;
  float all_threads = 0.0;
  for (uint k = 0; k < 64; ++k) all_threads += g_sums[k];
  sums[group.y * ((width + kTile - 1) / kTile) + group.x] = all_threads;
}

uint2 TileCount(uint width, uint height) {
  return uint2((width + kTile - 1) / kTile, (height + kTile - 1) / kTile);
}

// One group; its first thread adds up the tiles, in their order.
[shader("compute")]
[numthreads(8, 8, 1)]
void SumAll(uint thread : SV_GroupIndex) {
  if (thread != 0) return;
  uint width, height;
  result.GetDimensions(width, height);
  const uint2 tiles = TileCount(width, height);
  float sum = 0.0;
  for (uint i = 0; i < tiles.x * tiles.y; ++i) sum += sums[i];
  sums[tiles.x * tiles.y] = sum / (float(width) * float(height));
}

// In every frame another quarter of the blocks of 8 x 8 pixels is looked at, even where nothing
// varies. [Boksansky, Wimmer & Bittner 2019]
static const uint kMask[16] = {0, 3, 2, 1, 2, 1, 0, 3, 0, 3, 2, 1, 1, 2, 0, 3};

bool IsForced(uint2 pixel) {
  const uint2 block = pixel / 8 % 4;
  return kMask[block.y * 4 + block.x] == constants.frame_count % 4;
}

// Rays of a pixel whose history was found: one more than before while it varies too much, one less
// once it has been calm for as long as the counts have been the same. 0: nothing varies, and the
// last visibility stands.
uint ChooseCount(uint2 pixel, float variation, float4 counts, uint most, out float level) {
  const bool settled = counts.x == counts.y && counts.y == counts.z &&
                       (Has(kReleasedHistory) || counts.z == counts.w);
  level = counts.x;
  if (variation > constants.target) {
    level += 1.0;
  } else if (variation < constants.target && settled) {
    level -= 1.0;
  }
  level = clamp(level, 1.0, float(most));
  if (constants.budget > 0.0) {
    uint width, height;
    result.GetDimensions(width, height);
    const uint2 tiles = TileCount(width, height);
    const float over = sums[tiles.x * tiles.y] - constants.budget;
    if (over > 0.0) level = round(lerp(level, 1.0, saturate(2.0 * over)));
  }
  if (variation > 0.0 || variation_before[pixel].x > 0.0) return uint(level);
  return IsForced(pixel) ? 1 : 0;
}

// Sample `i` of `count` of a pixel: four frames of 3 x 3 pixels take 36 * count points of one
// sequence, each pixel's four frames a run of it, each frame a run of that.
float2 AdaptiveSample(uint2 pixel, uint count, uint i) {
  const uint place = pixel.y % 3 * 3 + pixel.x % 3;
  const uint index = (place * 4 + constants.frame_count % 4) * count + i;
  return SobolOwen(index, PcgHash(HashCombine(frame.seed, count)));
}

// 1: the point `u` of the light is visible.
float TraceLight(float3 position, float3 normal, float offset, float2 u) {
  float3 direction;
  float reach = kSunDistance;
  if (constants.light == kSun) {
    direction = SampleSun(u, frame.direction_to_sun, frame.tan_sun_radius);
  } else {
    const LightConstants light = lights[constants.light];
    const float3 to_center = light.position - position;
    const float distance = length(to_center);
    // Inside the light or on it, the light is visible; beyond its range or cone it does not count.
    if (!(distance > light.radius)) return 1.0;
    if (distance >= light.range) return 0.0;
    if (light.is_spot != 0 && !(dot(to_center, light.direction) < -light.cos_outer * distance)) {
      return 0.0;
    }
    const float3 target = to_center + ToWorld(float3(SampleDisk(u) * light.radius, 0.0),
                                              to_center / distance);
    reach = length(target);
    direction = target / reach;
    // The lamp's own surface must not shadow it.
    reach -= light.radius;
    if (!(reach > 0.0)) return 1.0;
  }
  if (!(dot(direction, normal) > 0.0)) return 0.0;
  return TraceVisibility(position + normal * offset, direction, reach);
}

[shader("raygeneration")]
void AdaptiveShadowRayGen() {
  const uint2 pixel = FramePixel();
  if (g_ids[pixel].x == 0) {
    visibility_now[pixel] = float4(1, 1, 1, 1);
    variation_now[pixel] = float4(0, 0, 0, 0);
    counts_now[pixel] = float4(0, 0, 0, 0);
    sampled[pixel] = float4(0, 0, 0, 0);
    return;
  }
  const float4 state = work[pixel];
  const bool found = state.y > 0.0;
  const uint most = max(pass_constants.sample_count, 1);
  const float4 history = visibility_now[pixel];
  const float4 counts = counts_now[pixel];
  const float4 variations = variation_now[pixel];
  float level = float(most);
  uint count = most;
  if (found && !Has(kUniform)) count = ChooseCount(pixel, state.x, counts, most, level);

  const float4 position = g_position[pixel];
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  float visible = 0.0;
  for (uint i = 0; i < count; ++i) {
    visible += TraceLight(position.xyz, normal, position.w, AdaptiveSample(pixel, count, i));
  }
  const float now = count > 0 ? visible / float(count) : history.x;
  sampled[pixel] = float4(float(count), state.x, state.x, 0);
  if (!found) {
    // All that is known is whether the light is visible in part.
    const float partly = now > 0.0 && now < 1.0 ? 1.0 : 0.0;
    visibility_now[pixel] = float4(now, now, now, now);
    variation_now[pixel] = float4(partly, partly, partly, partly);
    counts_now[pixel] = float4(level, level, level, level);
    sampled[pixel] = float4(float(count), state.x, partly, 0);
    return;
  }
  visibility_now[pixel] = float4(now, history.xyz);
  counts_now[pixel] = float4(level, counts.xyz);
  // The seed's measure is that of the frames before; the released code's that of this frame and the
  // three before it where they lie in the picture, wherever their surface has gone.
  const float newest =
      Has(kReleasedHistory) ? Range(float4(now, visibility_before[pixel].xyz)) : state.z;
  variation_now[pixel] =
      Has(kReleasedShift) ? float4(newest, variations.xxx) : float4(newest, variations.xyz);
}

// Averages neighbours, the more of them the more the visibility varies: a Gaussian 1 to 9 pixels
// wide, between two whole widths their mixture. Sums over the pixels of each half width.
static const int kFilterReach = 4;
static const float kGaussSums[5] = {1.0, 1.2706706, 2.4837318, 3.6945279, 4.8983480};

// The deviation is half the half width, so that the outermost pixel counts e^-2.
float Gauss(int half_width, int i) {
  if (half_width == 0) return i == 0 ? 1.0 : 0.0;
  if (abs(i) > half_width) return 0.0;
  const float part = float(i) / float(half_width);
  return exp(-2.0 * part * part) / kGaussSums[half_width];
}

float Smooth(RWTexture2D<float4> picture, int2 pixel, int2 step, int2 size, bool is_mean) {
  const float center = is_mean ? picture[pixel].x : Mean(visibility_now[pixel]);
  const float width = Has(kUnfiltered)
                          ? 0.0
                          : float(kFilterReach) * saturate(sampled[pixel].z /
                                                           constants.filter_variation);
  if (!(width > 0.0)) return center;
  const int lower = min(int(width), kFilterReach - 1);
  const float part = width - float(lower);
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  const float tolerance = DepthTolerance(normal);
  const float z = g_view_z[pixel];
  float sum = 0.0, weights = 0.0;
  for (int i = -kFilterReach; i <= kFilterReach; ++i) {
    const int2 tap = pixel + i * step;
    if (any(tap < int2(0, 0)) || any(tap >= size)) continue;
    const float weight = lerp(Gauss(lower, i), Gauss(lower + 1, i), part);
    if (!(weight > 0.0)) continue;
    if (i != 0 && (!IsSameDepth(z, g_view_z[tap], tolerance) ||
                   !(dot(normal, OctahedralDecode(g_normal[tap])) > 0.9))) {
      continue;
    }
    sum += weight * (is_mean ? picture[tap].x : Mean(visibility_now[tap]));
    weights += weight;
  }
  return sum / weights;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void SmoothAcross(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  result.GetDimensions(width, height);
  const int2 size = int2(width, height), pixel = int2(id.xy);
  if (any(pixel >= size)) return;
  other[pixel] = float4(Smooth(work, pixel, int2(1, 0), size, false), 0, 0, 0);
}

// And leaves the histories for the next frame.
[shader("compute")]
[numthreads(8, 8, 1)]
void SmoothDown(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  result.GetDimensions(width, height);
  const int2 size = int2(width, height), pixel = int2(id.xy);
  if (any(pixel >= size)) return;
  const float visibility = Smooth(other, pixel, int2(0, 1), size, true);
  result[pixel] = float4(visibility, visibility, visibility, 1.0);
  visibility_before[pixel] = visibility_now[pixel];
  variation_before[pixel] = variation_now[pixel];
  counts_before[pixel] = counts_now[pixel];
  view_z_before[pixel] = g_view_z[pixel];
}
