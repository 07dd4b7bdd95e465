// SPDX-License-Identifier: MIT
// Curvature to roughness: where normals vary within a pixel, a smooth surface reflects light from as
// many directions as a rougher one. Roughness that says so keeps small highlights from flickering.
// [Tokuyoshi & Kaplanyan 2019, Improved Geometric Specular Antialiasing; GDC 2018 talk: questions]
#include "frame.hlsli"

static const float kPixelVariance = 0.25;  // of the filter over a pixel, pixels squared
static const float kMostAdded = 0.18;      // to alpha squared

// Change of the normal towards a neighbour; none beyond the edge of the instance or the picture.
float3 ChangeTowards(int2 pixel, int2 offset, int2 size, float3 normal, out bool is_known) {
  const int2 other = pixel + offset;
  is_known = all(other >= int2(0, 0)) && all(other < size) &&
             g_ids[other].x == g_ids[pixel].x;
  if (!is_known) return float3(0, 0, 0);
  return OctahedralDecode(g_shading_normal[other]) - normal;
}

// Squared change of the normal per pixel along an axis. The smaller of both sides counts, so that a
// crease is not taken for a curve.
float SquaredChange(int2 pixel, int2 axis, int2 size, float3 normal) {
  bool has_before, has_behind;
  const float3 before = ChangeTowards(pixel, -axis, size, normal, has_before);
  const float3 behind = ChangeTowards(pixel, axis, size, normal, has_behind);
  if (!has_before) return dot(behind, behind);
  if (!has_behind) return dot(before, before);
  return min(dot(before, before), dot(behind, behind));
}

[shader("compute")]
[numthreads(8, 8, 1)]
void CurvatureToRoughness(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  g_material.GetDimensions(width, height);
  const int2 size = int2(width, height);
  const int2 pixel = int2(id.xy);
  if (any(pixel >= size) || g_ids[pixel].x == 0) return;
  const float3 normal = OctahedralDecode(g_shading_normal[pixel]);
  const float variance = kPixelVariance * (SquaredChange(pixel, int2(1, 0), size, normal) +
                                           SquaredChange(pixel, int2(0, 1), size, normal));
  float4 material = g_material[pixel];
  const float alpha = material.x * material.x;
  const float widened = sqrt(saturate(alpha * alpha + min(2.0 * variance, kMostAdded)));
  material.x = sqrt(widened);
  g_material[pixel] = material;
}
