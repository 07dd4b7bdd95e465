// SPDX-License-Identifier: MIT
// Mirror rays at a quarter of the pixels, spread over frames, and a blur that follows from roughness
// alone: the picture of mirrors, its mips, and a few taps in between. [Valient 2014, Killzone
// Shadow Fall]
#include "../screen_space/screen_follow.hlsli"

// As those of effects/reflections/traced, but no sum.
RWTexture2D<float4> reflection : register(u0, space3);
// The light that one of 2 x 2 pixels mirrors.
RWTexture2D<float4> rays : register(u1, space3);
// The light that all pixels mirror, and their view depths (0: sky): of the frame before and of this
// one.
RWTexture2D<float4> mirrored_before : register(u2, space3);
RWTexture2D<float4> mirrored : register(u3, space3);
// Its mips from half its size on, side by side.
RWTexture2D<float4> mips : register(u4, space3);

struct BlurredConstants {
  ScreenReflectionConstants screen;
  float fresh;         // 0 to 1: weight of a new ray beside what the pixel mirrored before
  float few_taps;      // roughness up to which 12 taps blur in place
  uint has_history;    // 0: there is no frame before
  uint level;          // that is made, from 1 on
};
ConstantBuffer<BlurredConstants> constants : register(b0, space3);

static const uint kLevels = 5;  // mips besides the full picture
static const uint kTaps = 12;
static const float kSameSurface = 0.05;  // of the view depth

uint2 LevelSize(uint level, uint2 size) { return max((size + (1u << level) - 1) >> level, 1u); }

uint LevelStart(uint level, uint2 size) {
  uint x = 0;
  for (uint i = 1; i < level; ++i) x += LevelSize(i, size).x;
  return x;
}

// The pixel of 2 x 2 that sends a ray in this frame; four frames have them all.
uint2 SendingOffset() {
  const uint i = pass_constants.first_sample;
  return uint2(i & 1, ((i >> 1) ^ i) & 1);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void SendMirrorRays(uint3 id : SV_DispatchThreadID) {
  const float2 size = PictureSize();
  const uint2 half_size = LevelSize(1, uint2(size));
  if (any(id.xy >= half_size)) return;
  const uint2 pixel = min(2 * id.xy + SendingOffset(), uint2(size) - 1);
  rays[id.xy] = float4(0, 0, 0, 0);
  if (g_ids[pixel].x == 0) return;
  const ReflectionPoint surface = LoadReflectionPoint(pixel);
  ReflectionRay ray;
  ray.direction = reflect(SeenAlong(g_position[pixel].xyz), surface.shading_normal);
  ray.exists = dot(ray.direction, surface.normal) > 0.0;
  ray.length = ReflectionLength(LengthsOf(constants.screen), 0.0, 0.0);
  ray.weight = float3(1, 1, 1);
  ray.u = 0.5;
  if (!ray.exists) return;
  ScreenHit hit;
  const float4 light = LightOfRay(pixel, surface, ray, constants.screen, true, size, hit);
  rays[id.xy] = float4(light.rgb, g_view_z[pixel]);
}

// Returns what the pixel mirrored in the frame before, where its surface was then; w: 0: unknown.
float4 MirroredBefore(uint2 pixel, float2 size) {
  if (constants.has_history == 0) return float4(0, 0, 0, 0);
  const float4 motion = g_motion[pixel];
  const float2 place = float2(pixel) + 0.5 + motion.xy * size;
  if (!IsInPicture(place, size)) return float4(0, 0, 0, 0);
  const float4 before = mirrored_before[int2(place)];
  const float view_z = g_view_z[pixel] + motion.z;
  return abs(before.w - view_z) <= kSameSurface * view_z ? before : float4(0, 0, 0, 0);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void GatherMirrorRays(uint3 id : SV_DispatchThreadID) {
  const uint2 pixel = id.xy;
  const float2 size = PictureSize();
  if (any(float2(pixel) >= size)) return;
  mirrored[pixel] = float4(0, 0, 0, 0);
  const float view_z = g_view_z[pixel];
  if (g_ids[pixel].x == 0) return;
  const float3 fresh = rays[pixel / 2].rgb;
  const float4 before = MirroredBefore(pixel, size);
  float3 light = fresh;
  if (before.w > 0.0) {
    const bool is_sent = all((pixel & 1) == SendingOffset());
    light = is_sent ? lerp(before.rgb, fresh, saturate(constants.fresh)) : before.rgb;
  }
  mirrored[pixel] = float4(light, view_z);
}

float4 LoadLevel(uint level, int2 texel, uint2 size) {
  const int2 inside = clamp(texel, int2(0, 0), int2(LevelSize(level, size)) - 1);
  if (level == 0) return mirrored[inside];
  return mips[uint2(inside) + uint2(LevelStart(level, size), 0)];
}

// A tent over 4 x 4 texels of the level above.
[shader("compute")]
[numthreads(8, 8, 1)]
void BlurLevel(uint3 id : SV_DispatchThreadID) {
  const uint2 size = uint2(PictureSize());
  if (any(id.xy >= LevelSize(constants.level, size))) return;
  float3 sum = float3(0, 0, 0);
  float weights = 0.0;
  for (int i = 0; i < 16; ++i) {
    const int2 offset = int2(i % 4, i / 4) - 1;
    const float weight = (offset.x == 0 || offset.x == 1 ? 3.0 : 1.0) *
                         (offset.y == 0 || offset.y == 1 ? 3.0 : 1.0);
    const float4 texel = LoadLevel(constants.level - 1, 2 * int2(id.xy) + offset, size);
    if (!(texel.w > 0.0)) continue;  // the sky mirrors nothing
    sum += weight * texel.rgb;
    weights += weight;
  }
  mips[id.xy + uint2(LevelStart(constants.level, size), 0)] =
      weights > 0.0 ? float4(sum / weights, 1.0) : float4(0, 0, 0, 0);
}

// Between texels of a level, without those of the sky.
float4 SampleLevel(uint level, float2 uv, uint2 size) {
  const float2 at = uv * float2(LevelSize(level, size)) - 0.5;
  const float2 corner = floor(at);
  const float2 part = at - corner;
  float4 sum = float4(0, 0, 0, 0);
  for (int i = 0; i < 4; ++i) {
    const int2 offset = int2(i & 1, i >> 1);
    const float weight = (offset.x == 1 ? part.x : 1.0 - part.x) *
                         (offset.y == 1 ? part.y : 1.0 - part.y);
    const float4 texel = LoadLevel(level, int2(corner) + offset, size);
    if (texel.w > 0.0) sum += weight * float4(texel.rgb, 1.0);
  }
  return sum;
}

// Two levels, by roughness.
float3 BlurByMips(float roughness, float2 uv, uint2 size) {
  const float level = saturate(roughness) * float(kLevels);
  const uint finer = min(uint(level), kLevels - 1);
  const float4 sum = lerp(SampleLevel(finer, uv, size), SampleLevel(finer + 1, uv, size),
                          level - float(finer));
  return sum.w > 0.0 ? sum.rgb / sum.w : float3(0, 0, 0);
}

// Smooth surfaces would show the first mip's texels: taps on a disk in the full picture instead.
float3 BlurByTaps(float roughness, float2 uv, uint2 size) {
  const float radius = exp2(roughness * float(kLevels)) - 1.0;  // pixels, as the mips are wide
  float4 sum = float4(0, 0, 0, 0);
  for (uint i = 0; i < kTaps; ++i) {
    const float r = sqrt((float(i) + 0.5) / float(kTaps)) * radius;
    const float phi = 2.3999632 * float(i);  // the golden angle
    sum += SampleLevel(0, uv + r * float2(cos(phi), sin(phi)) / float2(size), size);
  }
  return sum.w > 0.0 ? sum.rgb / sum.w : float3(0, 0, 0);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void BlurMirrored(uint3 id : SV_DispatchThreadID) {
  const uint2 size = uint2(PictureSize());
  if (any(id.xy >= size)) return;
  reflection[id.xy] = float4(0, 0, 0, 0);
  if (g_ids[id.xy].x == 0) return;
  const float roughness = g_material[id.xy].x;
  const float2 uv = (float2(id.xy) + 0.5) / float2(size);
  float3 light;
  if (IsMirror(roughness)) {
    light = mirrored[id.xy].rgb;
  } else if (roughness <= constants.few_taps) {
    light = BlurByTaps(roughness, uv, size);
  } else {
    light = BlurByMips(roughness, uv, size);
  }
  reflection[id.xy] = float4(light, 0.0);
}
