// SPDX-License-Identifier: MIT
// Measures how much a signal has changed since the previous frame, and not its noise: in each
// stratum of 3 x 3 pixels one sample of the previous frame is taken again, of the same surface and
// with the same random numbers. What then differs is light. [Schied et al. 2018, Gradient
// Estimation for Real-Time Adaptive Temporal Filtering]
#include "frame.hlsli"
#include "sampling.hlsli"

static const int kStratum = 3;      // pixels to a side
static const int kMostSignals = 8;  // effects/denoise/temporal_gradients.h
static const uint kNoSample = 0xFFFFFFFFu;

// Mirrors GradientConstants in effects/denoise/temporal_gradients.cpp.
struct GradientConstants {
  int columns;  // of strata
  int rows;
  int signals;
  int signal;        // CompareScalar, CompareColor: which one
  int component;     // CompareColor: the channel, 0 to 2; -1: the luminance of all three
  int spacing;       // FilterGradients: strata between taps
  uint pixel_step;   // of the samples of the previous frame, as PassConstants has it
  uint pixel_offset;
};
ConstantBuffer<GradientConstants> constants : register(b0, space3);

// An instance of the scene as it is now. [DXR: D3D12_RAYTRACING_INSTANCE_DESC]
struct InstanceNow {
  float4 rows[3];  // object to world, relative to the camera
  uint4 others;
};
StructuredBuffer<InstanceNow> instances : register(t0, space3);

// The previous frame's surfaces; moved_...: the same where and as they are now, relative to the
// camera, at pixels whose sample is taken again.
RWTexture2D<float4> past_position : register(u0, space3);
RWTexture2D<float2> past_normal : register(u1, space3);
RWTexture2D<uint2> past_ids : register(u2, space3);
RWTexture2D<float4> moved_position : register(u3, space3);
RWTexture2D<float2> past_shading_normal : register(u14, space3);
RWTexture2D<float2> moved_normal : register(u15, space3);
RWTexture2D<float2> moved_shading_normal : register(u16, space3);
// By stratum, as x + 65536 * y: the pixel of the previous frame whose sample is taken again, or
// kNoSample; and the same for the dispatch of rays, where every place needs a pixel.
RWStructuredBuffer<uint> samples : register(u4, space3);
RWStructuredBuffer<uint> order : register(u5, space3);
// A signal's sums: of the samples taken again, and of the previous frame.
RWTexture2D<float> scalar_now : register(u6, space3);
RWTexture2D<float> scalar_before : register(u7, space3);
RWTexture2D<float4> color_now : register(u8, space3);
RWTexture2D<float4> color_before : register(u9, space3);
// By signal and stratum: the difference of luminance, and the larger of the two.
RWStructuredBuffer<float2> gradients : register(u10, space3);
RWStructuredBuffer<float2> filtered : register(u11, space3);
// By pixel, a channel for each signal: 0 nothing changed, 1 nothing is as it was.
RWTexture2D<float4> changes[2] : register(u12, space3);

int2 PictureSize() {
  uint width, height;
  g_view_z.GetDimensions(width, height);
  return int2(width, height);
}

bool IsInside(int2 place, int2 size) { return all(place >= int2(0, 0)) && all(place < size); }
int2 Strata() { return int2(constants.columns, constants.rows); }
int StratumIndex(int2 stratum) { return stratum.y * constants.columns + stratum.x; }
int GradientIndex(int signal, int2 stratum) {
  return signal * constants.columns * constants.rows + StratumIndex(stratum);
}

// Another pixel of the stratum in each frame.
int2 PixelOfStratum(int2 stratum, int2 size) {
  const uint key = HashCombine(uint(StratumIndex(stratum)), frame.frame_index);
  return min(stratum * kStratum + int2(key % 3u, key / 3u % 3u), size - int2(1, 1));
}

// Metres that a pixel covers at this depth.
float Footprint(float view_z) {
  return GrowthAt(view_z) * 2.0 * length(frame.camera_up) / float(PictureSize().y);
}

// A surface of the previous frame, where and as it is now.
struct Moved {
  float4 position;
  float2 normal;  // encoded, as the next one
  float2 shading_normal;
};

float3x3 Linear(float4 rows[3]) { return float3x3(rows[0].xyz, rows[1].xyz, rows[2].xyz); }
float3 Translation(float4 rows[3]) { return float3(rows[0].w, rows[1].w, rows[2].w); }

// The matrix of cofactors: it turns normals where the matrix turns points, and transposed, over the
// determinant, it is the inverse.
float3x3 Cofactors(float3x3 m) {
  return float3x3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
}

float2 Turned(float3x3 cofactors, float2 encoded_normal) {
  return OctahedralEncode(normalize(mul(cofactors, OctahedralDecode(encoded_normal))));
}

// With an instance that moved as a whole.
Moved MoveWithInstance(uint instance, int2 past) {
  const PreviousInstance before = previous_instances[instance - 1];
  const float3x3 linear_before = Linear(before.rows);
  const float3x3 cofactors = Cofactors(linear_before);
  const float3x3 inverse =
      transpose(cofactors) * (1.0 / dot(linear_before[0], cofactors[0]));
  const InstanceNow now = instances[instance - 1];
  const float3x3 change = mul(Linear(now.rows), inverse);
  const float4 old = past_position[past];
  Moved moved;
  moved.position =
      float4(mul(change, old.xyz - Translation(before.rows)) + Translation(now.rows), old.w);
  const float3x3 turn = Cofactors(change);
  moved.normal = Turned(turn, past_normal[past]);
  moved.shading_normal = Turned(turn, past_shading_normal[past]);
  return moved;
}

// With a surface that changes its shape: as far as the point that the pixel shows now has moved, and
// with the normals of that point.
Moved MoveWithPixel(int2 pixel, int2 past) {
  const float3 position = g_position[pixel].xyz;
  float view_z;
  const float2 now = PictureUv(position, frame.camera_right, frame.over_right, frame.camera_up,
                               frame.over_up, frame.camera_forward, view_z);
  const float4 motion = g_motion[pixel];
  const CameraRay ray = RayOfCamera(2.0 * (now + motion.xy) - 1.0, frame.previous_right,
                                    frame.previous_up, frame.previous_forward);
  const float3 before = ray.origin + (view_z + motion.z) * ray.direction;
  Moved moved;
  moved.position = past_position[past];
  moved.position.xyz += position - before;
  moved.normal = g_normal[pixel];
  moved.shading_normal = g_shading_normal[pixel];
  return moved;
}

Moved MoveSurface(uint instance, int2 pixel, int2 past) {
  const uint flags = previous_instances[instance - 1].flags;
  if ((flags & kPreviousDeformed) != 0) return MoveWithPixel(pixel, past);
  if (flags != 0) return MoveWithInstance(instance, past);
  const float4 old = past_position[past];
  Moved still;
  still.position = float4(old.xyz - frame.camera_motion, old.w);
  still.normal = past_normal[past];
  still.shading_normal = past_shading_normal[past];
  return still;
}

// The pixel of the previous frame that showed this pixel's surface and had a sample.
uint FindSample(int2 pixel, int2 size) {
  const uint instance = g_ids[pixel].x;
  if (instance == 0) return kNoSample;
  const float2 motion = g_motion[pixel].xy;
  if (!isfinite(motion.x) || !isfinite(motion.y)) return kNoSample;
  const float2 before = float2(pixel) + 0.5 + motion * float2(size);
  if (any(before < float2(0, 0)) || any(before >= float2(size))) return kNoSample;
  int2 past = int2(before);
  if (constants.pixel_step == 2) {
    past = past / 2 * 2 + int2(constants.pixel_offset & 1u, constants.pixel_offset >> 1);
  }
  if (!IsInside(past, size) || past_ids[past].x != instance) return kNoSample;
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  const Moved moved = MoveSurface(instance, pixel, past);
  if (!(dot(OctahedralDecode(moved.normal), normal) >= 0.9)) return kNoSample;
  const float away = abs(dot(normal, moved.position.xyz - g_position[pixel].xyz));
  const float view_z = g_view_z[pixel];
  if (!(away <= Footprint(view_z) + 0.005 * view_z)) return kNoSample;
  moved_position[past] = moved.position;
  moved_normal[past] = moved.normal;
  moved_shading_normal[past] = moved.shading_normal;
  return uint(past.x) + 65536u * uint(past.y);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void PickSamples(uint3 id : SV_DispatchThreadID) {
  const int2 stratum = int2(id.xy);
  if (!IsInside(stratum, Strata())) return;
  const int2 size = PictureSize();
  const int2 pixel = PixelOfStratum(stratum, size);
  const uint sample = FindSample(pixel, size);
  const int index = StratumIndex(stratum);
  samples[index] = sample;
  order[index] = sample == kNoSample ? uint(pixel.x) + 65536u * uint(pixel.y) : sample;
  for (int s = 0; s < constants.signals; ++s) gradients[GradientIndex(s, stratum)] = float2(0, 0);
}

float Luminance(float3 color) { return dot(color, float3(0.2126, 0.7152, 0.0722)); }

// The difference is exactly 0 if the light is the same.
float2 Gradient(float3 now, float3 before) {
  const float larger = max(Luminance(now), Luminance(before));
  const float difference = Luminance(now - before);
  return isfinite(larger) && isfinite(difference) ? float2(difference, larger) : float2(0, 0);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void CompareScalar(uint3 id : SV_DispatchThreadID) {
  const int2 stratum = int2(id.xy);
  if (!IsInside(stratum, Strata())) return;
  const uint sample = samples[StratumIndex(stratum)];
  if (sample == kNoSample) return;
  const int2 pixel = int2(sample & 0xFFFFu, sample >> 16);
  const float now = scalar_now[pixel];
  const float before = scalar_before[pixel];
  gradients[GradientIndex(constants.signal, stratum)] =
      Gradient(float3(now, now, now), float3(before, before, before));
}

[shader("compute")]
[numthreads(8, 8, 1)]
void CompareColor(uint3 id : SV_DispatchThreadID) {
  const int2 stratum = int2(id.xy);
  if (!IsInside(stratum, Strata())) return;
  const uint sample = samples[StratumIndex(stratum)];
  if (sample == kNoSample) return;
  const int2 pixel = int2(sample & 0xFFFFu, sample >> 16);
  float3 now = color_now[pixel].rgb;
  float3 before = color_before[pixel].rgb;
  if (constants.component >= 0) {
    now = now[constants.component] * float3(1, 1, 1);
    before = before[constants.component] * float3(1, 1, 1);
  }
  gradients[GradientIndex(constants.signal, stratum)] = Gradient(now, before);
}

struct Surface {
  float3 position;
  float3 normal;
  float footprint;  // metres; 0: there is no surface
};

Surface SurfaceAt(int2 pixel) {
  Surface surface;
  surface.position = g_position[pixel].xyz;
  surface.normal = OctahedralDecode(g_normal[pixel]);
  surface.footprint = g_ids[pixel].x == 0 ? 0.0 : Footprint(g_view_z[pixel]);
  return surface;
}

// By distance from the surface's plane and by normals: light changes on a surface, and another one
// nearby may not see it.
float SurfaceWeight(Surface surface, Surface other) {
  if (other.footprint == 0.0) return 0.0;
  const float away = abs(dot(surface.normal, other.position - surface.position));
  const float cosine = saturate(dot(surface.normal, other.normal));
  const float squared = cosine * cosine;
  const float weight = squared * squared * exp(-away / (surface.footprint + 1e-20));
  return weight > 1e-6 ? weight : 0.0;
}

// One pass of a wavelet filter, 5 x 5 strata, from gradients to filtered. Differences keep their
// sign, so that noise in them goes away. Strata without a sample count as dark: only the ratio of
// the two matters.
[shader("compute")]
[numthreads(8, 8, 1)]
void FilterGradients(uint3 id : SV_DispatchThreadID) {
  const int2 stratum = int2(id.xy);
  if (!IsInside(stratum, Strata())) return;
  const float kernel[3] = {0.375, 0.25, 0.0625};  // cubic B-spline, from its centre
  const int2 size = PictureSize();
  const Surface surface = SurfaceAt(PixelOfStratum(stratum, size));
  float2 sums[kMostSignals];
  for (int s = 0; s < kMostSignals; ++s) sums[s] = float2(0, 0);
  for (int i = 0; i < 25 && surface.footprint > 0.0; ++i) {
    const int2 place = int2(i % 5 - 2, i / 5 - 2);
    const int2 other = stratum + place * constants.spacing;
    if (!IsInside(other, Strata())) continue;
    float weight = kernel[abs(place.x)] * kernel[abs(place.y)];
    if (i != 12) weight *= SurfaceWeight(surface, SurfaceAt(PixelOfStratum(other, size)));
    if (weight == 0.0) continue;
    for (int t = 0; t < constants.signals; ++t) {
      sums[t] += weight * gradients[GradientIndex(t, other)];
    }
  }
  for (int t = 0; t < constants.signals; ++t) filtered[GradientIndex(t, stratum)] = sums[t];
}

// Light of less than this is none: its change would be a ratio of roundings.
static const float kNoLight = 1e-12;

// The changes of each pixel, from the four strata around it.
[shader("compute")]
[numthreads(8, 8, 1)]
void WriteChanges(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = PictureSize();
  if (!IsInside(pixel, size)) return;
  const Surface surface = SurfaceAt(pixel);
  const float2 place = (float2(pixel) + 0.5) / float(kStratum) - 0.5;
  const float2 corner = floor(place);
  const float2 part = place - corner;
  float2 sums[kMostSignals];
  for (int s = 0; s < kMostSignals; ++s) sums[s] = float2(0, 0);
  for (int i = 0; i < 4 && surface.footprint > 0.0; ++i) {
    const int2 offset = int2(i & 1, i >> 1);
    const int2 stratum = int2(corner) + offset;
    if (!IsInside(stratum, Strata())) continue;
    const float weight = (offset.x == 1 ? part.x : 1.0 - part.x) *
                         (offset.y == 1 ? part.y : 1.0 - part.y) *
                         SurfaceWeight(surface, SurfaceAt(PixelOfStratum(stratum, size)));
    if (weight == 0.0) continue;
    for (int t = 0; t < constants.signals; ++t) {
      sums[t] += weight * gradients[GradientIndex(t, stratum)];
    }
  }
  float4 change[2] = {float4(0, 0, 0, 0), float4(0, 0, 0, 0)};
  for (int t = 0; t < constants.signals; ++t) {
    if (sums[t].y > kNoLight) change[t / 4][t % 4] = saturate(abs(sums[t].x) / sums[t].y);
  }
  changes[0][pixel] = change[0];
  changes[1][pixel] = change[1];
}
