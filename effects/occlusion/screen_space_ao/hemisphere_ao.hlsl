// SPDX-License-Identifier: MIT
// Ambient occlusion by points in the hemisphere above each surface, compared with the depth
// picture. An open wall is white, but what is low over the surface counts as much as what is above
// it. [survey 7.1]
#include "occlusion.hlsli"
#include "sampling.hlsli"

struct HemisphereConstants {
  uint filter_passes;  // of occlusion_filter.hlsl, for the host
  uint samples;        // points in the hemisphere
  float bias;          // of depth, in radii
  uint layers;         // of depth: 1, or 2 with second_view_z
  float separation;    // of the layers, in radii, for the host
};
ConstantBuffer<HemisphereConstants> hemisphere : register(b0, space3);

// What lies behind the first surface; 0: nothing. [effects/occlusion/second_layer]
Texture2D<float> second_view_z : register(t4, space3);

static const float kGoldenAngle = 2.39996323;

// Unit direction `index` of `count` about +z, the same density everywhere.
float3 DirectionInHemisphere(uint index, uint count, float turn) {
  const float height = (float(index) + 0.5) / float(count);
  const float across = sqrt(max(1.0 - height * height, 0.0));
  const float phi = kGoldenAngle * float(index) + turn;
  return float3(across * cos(phi), across * sin(phi), height);
}

// Returns how much a surface at a depth occludes a point, and fades with its distance to the centre.
float Occlusion(float other_z, float3 position, float3 centre, float radius) {
  if (!IsSurface(other_z) || other_z > position.z - hemisphere.bias * radius) return 0.0;
  return smoothstep(0.0, 1.0, radius / abs(centre.z - other_z));
}

[shader("compute")]
[numthreads(8, 8, 1)]
void HemisphereOcclusion(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = PictureSize();
  if (!IsInside(pixel, size)) return;
  const float view_z = g_view_z[pixel];
  const float radius = Radius();
  if (!IsSurface(view_z) || !(radius > 0.0)) {
    raw[pixel] = 1.0;
    return;
  }
  const float3 centre = ViewPosition(pixel, view_z, size);
  const float3 normal = ViewNormal(g_shading_normal[pixel], ToCamera(centre));
  const float2 noise = TileNoise(pixel);
  const uint count = max(hemisphere.samples, 1u);
  float occluded = 0.0;
  float seen = 0.0;
  for (uint i = 0; i < count; ++i) {
    // More points near the surface. Another order than that of the heights.
    const float place = (float((i * 7u) % count) + noise.y) / float(count);
    const float distance = radius * lerp(0.1, 1.0, place * place);
    const float3 direction = ToWorld(DirectionInHemisphere(i, count, kTwoPi * noise.x), normal);
    const float3 position = centre + distance * direction;
    if (!(position.z > 0.0)) continue;
    const int2 other = int2(floor(PlaceOf(position, size)));
    if (!IsInside(other, size)) continue;
    seen += 1.0;
    float most = Occlusion(g_view_z[other], position, centre, radius);
    if (hemisphere.layers > 1) {
      most = max(most, Occlusion(second_view_z[other], position, centre, radius));
    }
    occluded += most;
  }
  raw[pixel] = seen > 0.0 ? 1.0 - occluded / seen : 1.0;
}
