// SPDX-License-Identifier: MIT
// Light of the volume at each surface, times screen-space ambient occlusion: what games did before
// rays. [GDC 2018 talk; Northlight deck: Indirect Diffuse Illumination]
#include "frame.hlsli"
#include "indirect_volume.hlsli"

RWTexture2D<float4> indirect : register(u0, space3);   // irradiance / pi
RWTexture2D<float4> occlusion : register(u1, space3);  // 1: open
RWTexture2D<float4> bent_normal : register(u2, space3);

struct OccludeConstants {
  uint bent_normals;  // 1: light is read about the mean open direction
};
ConstantBuffer<OccludeConstants> constants : register(b0, space3);

[shader("compute")]
[numthreads(8, 8, 1)]
void OccludeVolume(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  indirect.GetDimensions(width, height);
  const uint2 pixel = id.xy;
  if (pixel.x >= width || pixel.y >= height) return;
  if (g_ids[pixel].x == 0) {
    indirect[pixel] = float4(0, 0, 0, 0);
    return;
  }
  float3 normal = OctahedralDecode(g_shading_normal[pixel]);
  if (constants.bent_normals != 0) normal = bent_normal[pixel].xyz;
  const float3 light = VolumeIrradianceAt(g_position[pixel].xyz, kEveryCell, normal);
  indirect[pixel] = float4(light * occlusion[pixel].rgb, 0.0);
}
