// SPDX-License-Identifier: MIT
// The small filters of screen-space ambient occlusion: the mean of 4 x 4 pixels, which sees every
// pixel of the tile of noise once, or of 5 x 5, both without what lies at another depth.
// [Mittring 2007; Jimenez et al. 2016]
#include "occlusion.hlsli"

struct FilterConstants {
  int before;       // pixels that the filter reaches to the left and up
  int behind;       // to the right and down
  uint edge_aware;  // 0: blurs over edges
  uint from;        // 0: reads raw, 1: reads filtered
  uint to;          // 0: writes raw, 1: writes filtered, 2: writes the result
  float power;      // on the result
  float least;      // of the result
};
ConstantBuffer<FilterConstants> filter : register(b0, space3);

// Change of the depth from one pixel to the next, by the side where it changes less.
float Slope(int2 pixel, int2 axis, float view_z, int2 size) {
  const float before = IsInside(pixel - axis, size) ? g_view_z[pixel - axis] : 0.0;
  const float behind = IsInside(pixel + axis, size) ? g_view_z[pixel + axis] : 0.0;
  const bool has_before = IsSurface(before);
  const bool has_behind = IsSurface(behind);
  if (has_before && (!has_behind || abs(view_z - before) < abs(behind - view_z))) return view_z - before;
  return has_behind ? behind - view_z : 0.0;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void FilterOcclusion(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = PictureSize();
  if (!IsInside(pixel, size)) return;
  const float view_z = g_view_z[pixel];
  float visibility = 1.0;
  if (IsSurface(view_z)) {
    const float2 gradient = float2(Slope(pixel, int2(1, 0), view_z, size),
                                   Slope(pixel, int2(0, 1), view_z, size));
    float sum = 0.0;
    float weights = 0.0;
    for (int y = -filter.before; y <= filter.behind; ++y) {
      for (int x = -filter.before; x <= filter.behind; ++x) {
        const int2 other = pixel + int2(x, y);
        if (!IsInside(other, size)) continue;
        const float other_z = g_view_z[other];
        if (!IsSurface(other_z)) continue;
        // Off the plane of this pixel by a hundredth of the depth: another surface. [XeGTAO: edges]
        const float off = abs(other_z - view_z - dot(gradient, float2(x, y)));
        const float weight = filter.edge_aware != 0 ? saturate(1.25 - off / (0.011 * view_z)) : 1.0;
        sum += weight * (filter.from == 0 ? raw[other] : filtered[other]);
        weights += weight;
      }
    }
    visibility = sum / weights;
  }
  if (filter.to == 0) raw[pixel] = visibility;
  if (filter.to == 1) filtered[pixel] = visibility;
  if (filter.to != 2) return;
  visibility = max(pow(saturate(visibility), filter.power), filter.least);
  result[pixel] = float4(visibility, visibility, visibility, 1.0);
}
