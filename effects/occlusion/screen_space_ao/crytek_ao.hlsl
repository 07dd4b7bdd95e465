// SPDX-License-Identifier: MIT
// Crysis' ambient occlusion: the part of a sphere about each point that is not behind the depth
// picture. Half of the sphere is inside of an open wall, so walls are grey. [Mittring 2007, Finding
// Next Gen]
#include "occlusion.hlsli"
#include "sampling.hlsli"

struct CrytekConstants {
  uint filter_passes;  // of occlusion_filter.hlsl, for the host
  uint samples;  // points in the sphere; they come in pairs
  uint remap;    // 1: min(1, 2 * part), so that an open wall is white
};
ConstantBuffer<CrytekConstants> crytek : register(b0, space3);

static const float kGoldenAngle = 2.39996323;

// Point `index` of `count` in the upper half of the unit sphere, the same density everywhere.
float3 PointInHalfSphere(uint index, uint count) {
  const float height = (float(index) + 0.5) / float(count);
  const float across = sqrt(max(1.0 - height * height, 0.0));
  const float phi = kGoldenAngle * float(index);
  // Another order than that of the heights.
  const float distance = pow((float((index * 5u) % count) + 0.5) / float(count), 1.0 / 3.0);
  return distance * float3(across * cos(phi), across * sin(phi), height);
}

// Returns how much of a point of the sphere is in front of the picture's depth: 0 or 1, or between
// if something far in front of the sphere hides it.
float Passes(float3 centre, float3 position, float radius, int2 size) {
  if (!(position.z > 0.0)) return 1.0;
  // Outside of the picture, its border goes on.
  const int2 pixel = clamp(int2(floor(PlaceOf(position, size))), int2(0, 0), size - 1);
  const float view_z = g_view_z[pixel];
  if (!IsSurface(view_z) || view_z >= position.z) return 1.0;
  return 1.0 - smoothstep(0.0, 1.0, radius / abs(centre.z - view_z));
}

[shader("compute")]
[numthreads(8, 8, 1)]
void CrytekOcclusion(uint3 id : SV_DispatchThreadID) {
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
  // The points are reflected at a plane that is another one for each of 4 x 4 pixels.
  const float2 noise = TileNoise(pixel);
  const float height = 1.0 - noise.x;
  const float across = sqrt(max(1.0 - height * height, 0.0));
  const float3 plane = float3(across * cos(kTwoPi * noise.y), across * sin(kTwoPi * noise.y), height);

  const uint pairs = max(crytek.samples / 2u, 1u);
  float passes = 0.0;
  for (uint i = 0; i < pairs; ++i) {
    const float3 offset = radius * reflect(PointInHalfSphere(i, pairs), plane);
    passes += Passes(centre, centre + offset, radius, size);
    passes += Passes(centre, centre - offset, radius, size);
  }
  const float part = passes / float(2u * pairs);
  raw[pixel] = crytek.remap != 0 ? min(2.0 * part, 1.0) : part;
}
