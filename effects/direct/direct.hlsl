// SPDX-License-Identifier: MIT
// Main lighting: what each pixel's surface sends to the camera of the local lights. The strongest
// point light and the strongest spot light are left to the contact shadow pass and only named here.
// [effects-spec A22, B2.12]
#include "hit_lighting.hlsli"

RWTexture2D<float4> direct : register(u0, space3);       // radiance
RWTexture2D<uint2> strongest : register(u1, space3);     // point light, spot light; kNoLight: none

static const uint kNoLight = 0xFFFFFF;  // survives a picture of floats

struct DirectConstants {
  uint leave_out_strongest;
};
ConstantBuffer<DirectConstants> constants : register(b0, space3);

Brdf PixelBrdf(uint2 pixel) {
  return MakeBrdf(LinearFromSrgb(g_base_color[pixel].rgb), g_material[pixel].y, g_material[pixel].x);
}

float3 PixelView(uint2 pixel) { return normalize(-g_position[pixel].xyz); }

[shader("compute")]
[numthreads(8, 8, 1)]
void MainLighting(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  direct.GetDimensions(width, height);
  const uint2 pixel = id.xy;
  if (pixel.x >= width || pixel.y >= height) return;
  direct[pixel] = float4(0, 0, 0, 0);
  strongest[pixel] = uint2(kNoLight, kNoLight);
  if (g_ids[pixel].x == 0) return;

  const Brdf brdf = PixelBrdf(pixel);
  const float3 position = g_position[pixel].xyz;
  const float3 geometric_normal = OctahedralDecode(g_normal[pixel]);
  const float3 normal = OctahedralDecode(g_shading_normal[pixel]);
  const float3 view = PixelView(pixel);
  const uint cluster = ClusterOf(position);
  const uint count = ClusterLightCount(cluster);

  uint2 best = uint2(kNoLight, kNoLight);
  float2 best_luminance = float2(0, 0);
  for (uint i = 0; i < count; ++i) {
    const uint light = ClusterLight(cluster, i);
    const float luminance =
        RadianceLuminance(LightRadiance(lights[light], brdf, position, normal, view));
    const uint kind = lights[light].is_spot;
    if (luminance > best_luminance[kind]) {
      best_luminance[kind] = luminance;
      best[kind] = light;
    }
  }
  float3 sum = float3(0, 0, 0);
  for (uint j = 0; j < count; ++j) {
    const uint light = ClusterLight(cluster, j);
    if (constants.leave_out_strongest != 0 && any(light == best)) continue;
    sum += ShadowedLightRadiance(light, brdf, position, geometric_normal, normal, view);
  }
  direct[pixel] = float4(sum, 1.0);
  strongest[pixel] = best;
}

RWTexture2D<float4> contact : register(u2, space3);  // visibility: r point light, g spot light
RWTexture2D<float4> total : register(u3, space3);

// Adds the two lights that were left out: shadow map times contact shadow. [Control: section 5.3.1]
[shader("compute")]
[numthreads(8, 8, 1)]
void AddStrongest(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  direct.GetDimensions(width, height);
  const uint2 pixel = id.xy;
  if (pixel.x >= width || pixel.y >= height) return;
  float3 sum = direct[pixel].rgb;
  if (g_ids[pixel].x != 0) {
    const Brdf brdf = PixelBrdf(pixel);
    const float3 position = g_position[pixel].xyz;
    const float3 geometric_normal = OctahedralDecode(g_normal[pixel]);
    const float3 normal = OctahedralDecode(g_shading_normal[pixel]);
    const float3 view = PixelView(pixel);
    for (uint kind = 0; kind < 2; ++kind) {
      const uint light = strongest[pixel][kind];
      if (light == kNoLight) continue;
      sum += contact[pixel][kind] *
             ShadowedLightRadiance(light, brdf, position, geometric_normal, normal, view);
    }
  }
  total[pixel] = float4(sum, 1.0);
}
