// SPDX-License-Identifier: MIT
// Upscales a signal traced at one pixel of each 2 x 2: joint bilateral upscaling. [Kopf et al.
// 2007, Joint Bilateral Upsampling]
#include "denoise_common.hlsli"

// Sums over samples; only TracedOffset() of each 2 x 2 pixels is written.
RWTexture2D<float4> source : register(u0, space3);
RWTexture2D<float4> result : register(u1, space3);
RWTexture2D<float> scalar_source : register(u2, space3);

static const int kStep = 2;  // pixels from one traced pixel to the next

// The block whose traced pixel is the last one up to here, to the right and below; -1 before the
// first.
int2 BlockBefore(int2 pixel) { return (pixel - TracedOffset() + kStep) / kStep - 1; }

struct Traced {
  float4 light;
  bool valid;
};

struct Sum {
  float4 light;
  float weight;
};

bool IsFinite(float4 value) { return all(isfinite(value)); }

float Tent(int distance) { return max(1.0 - abs(float(distance)) / float(kStep), 0.0); }

static const int kNormalSquarings = 4;  // the cosine to the 16th power

// Weight of a traced pixel for another pixel by depth and normal, not by distance.
float SurfaceWeight(Guide guide, int2 traced, int2 offset) {
  const float z = g_view_z[traced];
  if (!(z > 0.0)) return 0.0;
  const float4 other = float4(OctahedralDecode(g_shading_normal[traced]), z);
  const float weight = NormalWeight(guide, other, kNormalSquarings) *
                       exp(-DepthDistance(guide, other, offset));
  return isfinite(weight) ? weight : 0.0;
}

// Change of the depth to the next pixel along an axis. At the border, one side has no neighbour.
float Slope(int2 pixel, int2 axis, int2 size) {
  const float z = g_view_z[pixel];
  const bool has_before = IsInside(pixel - axis, size);
  const bool has_after = IsInside(pixel + axis, size);
  const float before = has_before ? z - g_view_z[pixel - axis] : 0.0;
  const float after = has_after ? g_view_z[pixel + axis] - z : 0.0;
  if (!has_before) return after;
  return has_after ? Smaller(before, after) : before;
}

// Like LoadGuide(), but from the G-buffer: this runs before the guides are prepared.
Guide GuideOf(int2 pixel, int2 size) {
  Guide guide;
  guide.view_z = g_view_z[pixel];
  guide.normal = OctahedralDecode(g_shading_normal[pixel]);
  guide.gradient = float2(Slope(pixel, int2(1, 0), size), Slope(pixel, int2(0, 1), size));
  guide.gradient *= denoise.sigma_z;
  guide.least_slope = 5e-3 * guide.view_z;
  return guide;
}

Traced LoadTraced(int2 pixel, bool is_scalar) {
  Traced traced;
  if (is_scalar) {
    const float value = scalar_source[pixel];
    traced.light = float4(value, value, value, 0.0);
  } else {
    traced.light = source[pixel];
  }
  traced.valid = IsFinite(traced.light);
  traced.light *= denoise.scale;
  return traced;
}

// `reach` is the number of traced pixels to each side.
Sum Gather(int2 pixel, int2 size, Guide guide, int reach, bool is_scalar) {
  Sum sum;
  sum.light = float4(0, 0, 0, 0);
  sum.weight = 0.0;
  const int2 corner = BlockBefore(pixel);
  for (int y = 1 - reach; y <= reach; ++y) {
    for (int x = 1 - reach; x <= reach; ++x) {
      const int2 other = (corner + int2(x, y)) * kStep + TracedOffset();
      if (!IsInside(other, size)) continue;
      const int2 offset = other - pixel;
      const float by_place = reach == 1 ? Tent(offset.x) * Tent(offset.y)
                                        : exp(-0.5 * dot(float2(offset), float2(offset)));
      if (by_place == 0.0) continue;
      const float weight = by_place * SurfaceWeight(guide, other, offset);
      if (weight == 0.0) continue;
      const Traced traced = LoadTraced(other, is_scalar);
      if (!traced.valid) continue;
      sum.light += weight * traced.light;
      sum.weight += weight;
    }
  }
  return sum;
}

// For thin things, where no traced pixel nearby is on the same surface: mostly the nearest in
// depth. Those at nearly the same depth count alike, so that rounding does not choose between them.
float4 NearestInDepth(int2 pixel, int2 size, Guide guide, bool is_scalar) {
  float4 light = float4(0, 0, 0, 0);
  float weights = 0.0;
  const int2 corner = BlockBefore(pixel);
  for (int y = -1; y <= 2; ++y) {
    for (int x = -1; x <= 2; ++x) {
      const int2 other = (corner + int2(x, y)) * kStep + TracedOffset();
      if (!IsInside(other, size)) continue;
      const float z = g_view_z[other];
      const Traced traced = LoadTraced(other, is_scalar);
      if (!(z > 0.0) || !traced.valid) continue;
      const float away = abs(z - guide.view_z) / guide.view_z + 1e-2;
      const float weight = 1.0 / (away * away);
      if (!isfinite(weight)) continue;
      light += weight * traced.light;
      weights += weight;
    }
  }
  return weights > 0.0 ? light / weights : float4(0, 0, 0, 0);
}

float4 Upscaled(int2 pixel, int2 size, bool is_scalar) {
  if (!(g_view_z[pixel] > 0.0)) {
    const int2 near = pixel / kStep * kStep + TracedOffset();
    if (!IsInside(near, size)) return float4(0, 0, 0, 0);
    const Traced traced = LoadTraced(near, is_scalar);
    return traced.valid && !(g_view_z[near] > 0.0) ? traced.light : float4(0, 0, 0, 0);
  }
  const Guide guide = GuideOf(pixel, size);
  Sum sum = Gather(pixel, size, guide, 1, is_scalar);
  // Below a thousandth, rounding would determine the picture.
  if (!(sum.weight > 1e-3)) sum = Gather(pixel, size, guide, 2, is_scalar);
  if (!(sum.weight > 1e-6)) return NearestInDepth(pixel, size, guide, is_scalar);
  return sum.light / sum.weight;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void UpscaleScalar(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(result);
  if (!IsInside(pixel, size)) return;
  result[pixel] = Upscaled(pixel, size, true);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void UpscaleColor(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = SizeOf(result);
  if (!IsInside(pixel, size)) return;
  result[pixel] = Upscaled(pixel, size, false);
}
