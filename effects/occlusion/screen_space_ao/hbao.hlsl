// SPDX-License-Identifier: MIT
// Horizon-based ambient occlusion: marches over the depth picture in a few directions and adds up
// how far the sine of the horizon rises above that of the surface itself. [Bavoil, Sainz and
// Dimitrov 2008]
#include "horizons.hlsli"
#include "occlusion.hlsli"
#include "sampling.hlsli"

struct HbaoConstants {
  uint filter_passes;  // of occlusion_filter.hlsl, for the host
  uint directions;
  uint steps;        // in each direction
  float angle_bias;  // radians that the horizon must rise above the surface
  float strength;
  float most_pixels;  // that a march is long
  uint half_resolution;  // 1: one of each 2 x 2 pixels is looked at
  uint rotations;        // frames after which the directions repeat; 0: the same in each
  float fresh;           // least weight of a new frame, by occlusion_filter.hlsl; 1: none before
};
ConstantBuffer<HbaoConstants> hbao : register(b0, space3);

// Returns the occlusion in one direction: up to 1.
float HorizonOcclusion(int2 pixel, float3 centre, float3 normal, float3 direction, float jitter,
                       int2 size) {
  const float3 to_camera = ToCamera(centre);
  const float radius = Radius();
  const float2 per_metre = PixelsPerMetre(centre, direction, size);
  const float reach = min(radius * length(per_metre), hbao.most_pixels);
  if (!(reach >= 1.0)) return 0.0;
  const float2 way = normalize(per_metre);
  // The surface itself rises by -gamma towards `direction`.
  const float gamma = ProjectNormal(normal, direction, to_camera).gamma;
  float sine = sin(min(hbao.angle_bias - gamma, kHalfPi));
  float occlusion = 0.0;
  for (uint i = 0; i < hbao.steps; ++i) {
    const float along = 1.0 + (reach - 1.0) * (float(i) + jitter) / float(hbao.steps);
    const int2 other = int2(floor(float2(pixel) + 0.5 + along * way));
    if (!IsInside(other, size)) break;
    const float view_z = g_view_z[other];
    if (!IsSurface(view_z)) continue;
    const float3 delta = ViewPosition(other, view_z, size) - centre;
    const float distance = length(delta);
    if (distance > radius || distance < 1e-6 * centre.z) continue;
    const float other_sine = dot(delta, to_camera) / distance;
    if (other_sine <= sine) continue;
    const float part = distance / radius;
    occlusion += (1.0 - part * part) * (other_sine - sine);
    sine = other_sine;
  }
  return occlusion;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void HorizonBasedOcclusion(uint3 id : SV_DispatchThreadID) {
  const int2 block = int2(id.xy);
  const int2 size = PictureSize();
  const int step_pixels = hbao.half_resolution != 0 ? 2 : 1;
  if (!IsInside(block, Blocks(size, step_pixels))) return;
  const int2 pixel = PixelOfBlock(block, step_pixels, hbao.fresh < 1.0, size);
  const float view_z = g_view_z[pixel];
  if (!IsSurface(view_z) || !(Radius() > 0.0)) {
    raw[pixel] = 1.0;
    return;
  }
  const float3 centre = ViewPosition(pixel, view_z, size);
  const float3 to_camera = ToCamera(centre);
  const float3 normal = ViewNormal(g_normal[pixel], to_camera);
  const ViewBasis basis = MakeViewBasis(to_camera);
  const float2 noise = RotatedNoise(block, hbao.rotations);
  const uint count = max(hbao.directions, 1u);
  float occlusion = 0.0;
  for (uint i = 0; i < count; ++i) {
    const float phi = kTwoPi * (float(i) + noise.x) / float(count);
    const float3 direction = cos(phi) * basis.right + sin(phi) * basis.up;
    occlusion += HorizonOcclusion(pixel, centre, normal, direction, noise.y, size);
  }
  raw[pixel] = saturate(1.0 - hbao.strength * occlusion / float(count));
}
