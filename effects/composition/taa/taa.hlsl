// SPDX-License-Identifier: MIT
// Temporal antialiasing: blends the frame's jittered radiance into the accumulated history.
// [Karis 2014, High-Quality Temporal Supersampling]
#include "frame.hlsli"

// Mirrors TaaConstants in effects/composition/taa/taa.h.
struct TaaConstants {
  float alpha;            // least weight of the new frame
  float clip_gamma;       // clips history to mean +- gamma deviations of 3 x 3; 0: no clipping
  float depth_tolerance;  // relative
  uint history_valid;     // 0: there is no previous frame
};
ConstantBuffer<TaaConstants> taa : register(b0, space3);

RWTexture2D<float4> history : register(u0, space3);  // rgb, and the number of frames in it
RWTexture2D<float4> result : register(u1, space3);
// For the previous and this frame: motion in pixels, and view depth (0: no surface).
RWTexture2D<float4> previous_surface : register(u2, space3);
RWTexture2D<float4> next_surface : register(u3, space3);

static const float kFar = 1e30;
static const float kSameMotion = 0.25;  // pixels per frame
static const float kLeastWeight = 0.05;

bool IsFinite(float3 color) { return isfinite(color.x) && isfinite(color.y) && isfinite(color.z); }

float Largest(float3 color) { return max(abs(color.x), max(abs(color.y), abs(color.z))); }

int2 Clamped(int2 pixel, int2 size) { return clamp(pixel, int2(0, 0), size - 1); }

float3 ToYCoCg(float3 c) {
  return float3(dot(c, float3(0.25, 0.5, 0.25)), dot(c, float3(0.5, 0.0, -0.5)),
                dot(c, float3(-0.25, 0.5, -0.25)));
}

float3 FromYCoCg(float3 c) {
  const float t = c.x - c.z;
  return float3(t + c.y, c.x + c.z, t - c.y);
}

// Mean and deviation of the new frame around a pixel, relative to the largest value there. That
// keeps very bright and very dark frames in the range of floats and makes the result independent of
// exposure.
struct Neighbourhood {
  float scale;
  float3 mean;  // YCoCg
  float3 deviation;
};

Neighbourhood LookAround(int2 pixel, int2 size) {
  Neighbourhood n;
  n.scale = 0.0;
  n.mean = float3(0, 0, 0);
  n.deviation = float3(0, 0, 0);
  float3 colors[9];
  for (int i = 0; i < 9; ++i) {
    const float3 c = radiance[Clamped(pixel + int2(i % 3 - 1, i / 3 - 1), size)].rgb;
    colors[i] = c;
    if (IsFinite(c)) n.scale = max(n.scale, Largest(c));
  }
  if (n.scale == 0.0) return n;  // black, or nothing is finite
  float count = 0.0;
  for (int j = 0; j < 9; ++j) {
    if (!IsFinite(colors[j])) continue;
    colors[j] = ToYCoCg(colors[j] / n.scale);
    n.mean += colors[j];
    count += 1.0;
  }
  n.mean /= count;
  for (int k = 0; k < 9; ++k) {
    if (!IsFinite(colors[k])) continue;
    const float3 difference = colors[k] - n.mean;
    n.deviation += difference * difference;
  }
  n.deviation = sqrt(n.deviation / count);
  return n;
}

// The place of the pixel's surface in the previous frame: offset in pixels, and its depth then. At
// a silhouette it is that of the nearest surface in 3 x 3 pixels, so that the edge stays smooth in
// motion.
struct Source {
  float2 offset;
  float view_z;  // kFar: sky
  bool known;
};

Source FindSource(int2 pixel, int2 size) {
  int2 nearest = pixel;
  float nearest_z = kFar;
  for (int i = 0; i < 9; ++i) {
    const int2 other = Clamped(pixel + int2(i % 3 - 1, i / 3 - 1), size);
    const float z = g_view_z[other];
    if (z > 0.0 && z < nearest_z) {
      nearest_z = z;
      nearest = other;
    }
  }
  Source source;
  if (nearest_z < kFar) {
    const float4 motion = g_motion[nearest];
    source.offset = motion.xy * float2(size);
    source.view_z = nearest_z + motion.z;
  } else {
    // The sky is infinitely far away; only the camera's rotation moves it.
    const float2 ndc = (float2(pixel) + 0.5) / float2(size) * 2.0 - 1.0;
    const float3 direction = RayThrough(ndc).direction;
    const float along = dot(direction, frame.previous_forward);
    float2 before =
        float2(dot(direction, frame.previous_right) / dot(frame.previous_right, frame.previous_right),
               -dot(direction, frame.previous_up) / dot(frame.previous_up, frame.previous_up)) /
        along;
    // Parallel rays all see the same of it.
    if (frame.is_orthographic != 0) before = ndc;
    source.offset = along > 0.0 ? 0.5 * (before - ndc) * float2(size) : float2(kFar, kFar);
    source.view_z = kFar;
  }
  source.known = isfinite(source.offset.x) && isfinite(source.offset.y) && isfinite(source.view_z);
  return source;
}

// Tells whether the pixel showed something in front of the surface that has moved away since. A
// thing that moves with the surface is still there; it may be too thin for the rays of every frame
// to hit it.
bool WasHidden(int2 pixel, Source source) {
  const float4 before = previous_surface[pixel];
  if (before.z == 0.0 || before.z >= source.view_z * (1.0 - taa.depth_tolerance)) return false;
  const float2 apart = abs(before.xy - source.offset);
  return max(apart.x, apart.y) > kSameMotion;
}

// Catmull-Rom weights of four values, for a place `t` after the second. [Catmull & Rom 1974]
void CubicWeights(float t, out float weights[4]) {
  weights[0] = t * (-0.5 + t * (1.0 - 0.5 * t));
  weights[1] = 1.0 + t * t * (-2.5 + 1.5 * t);
  weights[2] = t * (0.5 + t * (2.0 - 1.5 * t));
  weights[3] = t * t * (-0.5 + 0.5 * t);
}

float3 SampleCubic(float2 at, int2 size) {
  const float2 corner = floor(at);
  float wx[4], wy[4];
  CubicWeights(at.x - corner.x, wx);
  CubicWeights(at.y - corner.y, wy);
  float3 color = float3(0, 0, 0);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      // Exactly on a pixel, skip the others: huge values there would round it away.
      const float weight = wx[x] * wy[y];
      if (weight == 0.0) continue;
      color += weight * history[Clamped(int2(corner) + int2(x - 1, y - 1), size)].rgb;
    }
  }
  return max(color, float3(0, 0, 0));
}

// History between pixels, and the number of frames in it (0: unknown). If some of the four pixels
// showed what hid the surface, only the others are used.
float4 SampleHistory(Source source, float2 at, int2 size) {
  const float2 corner = floor(at);
  const float2 part = at - corner;
  float4 known = float4(0, 0, 0, 0);
  float weights = 0.0, heaviest = 0.0;
  bool all_known = true;
  for (int i = 0; i < 4; ++i) {
    const int2 offset = int2(i & 1, i >> 1);
    const float weight = (offset.x == 1 ? part.x : 1.0 - part.x) *
                         (offset.y == 1 ? part.y : 1.0 - part.y);
    if (weight == 0.0) continue;
    const int2 tap = Clamped(int2(corner) + offset, size);
    if (WasHidden(tap, source)) {
      all_known = false;
      continue;
    }
    known.rgb += weight * history[tap].rgb;
    weights += weight;
    if (weight > heaviest) {
      heaviest = weight;
      known.w = history[tap].w;
    }
  }
  if (weights < kLeastWeight) return float4(0, 0, 0, 0);
  return float4(all_known ? SampleCubic(at, size) : known.rgb / weights, known.w);
}

// Clips a history outside the box of neighbouring colours: moves it towards the centre to the
// boundary.
float3 Clip(float3 color, Neighbourhood n) {
  const float3 from_mean = ToYCoCg(color) - n.mean;
  const float3 box = taa.clip_gamma * n.deviation + 1e-6;
  const float3 outside = abs(from_mean) / box;
  const float most = max(outside.x, max(outside.y, outside.z));
  return most > 1.0 ? max(FromYCoCg(n.mean + from_mean / most), float3(0, 0, 0)) : color;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void Resolve(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  result.GetDimensions(width, height);
  const int2 size = int2(width, height);
  const int2 pixel = int2(id.xy);
  if (any(pixel >= size)) return;
  const float2 motion = g_motion[pixel].xy * float2(size);
  next_surface[pixel] = float4(motion, g_view_z[pixel], 0.0);
  const Neighbourhood around = LookAround(pixel, size);
  float3 color = radiance[pixel].rgb;
  // Replace NaN by the mean of the neighbours.
  if (!IsFinite(color)) color = max(FromYCoCg(around.mean), float3(0, 0, 0)) * around.scale;
  result[pixel] = float4(color, 1.0);
  if (taa.history_valid == 0) return;
  const Source source = FindSource(pixel, size);
  const float2 at = float2(pixel) + source.offset;
  if (!source.known || !all(at >= float2(-0.5, -0.5)) || !all(at < float2(size) - 0.5)) return;
  const float4 before = SampleHistory(source, at, size);
  if (before.w == 0.0 || !IsFinite(before.rgb)) return;
  float3 old = before.rgb;
  if (taa.clip_gamma > 0.0) {
    // In black surroundings, the history is dropped.
    old = around.scale > 0.0 ? Clip(old / around.scale, around) * around.scale : float3(0, 0, 0);
    if (!IsFinite(old)) return;
  }
  const float frames = min(before.w + 1.0, 1024.0);
  result[pixel] = float4(lerp(old, color, max(taa.alpha, 1.0 / frames)), frames);
}
