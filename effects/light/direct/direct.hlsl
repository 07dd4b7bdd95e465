// SPDX-License-Identifier: MIT
// Main lighting: local light that each pixel's surface reflects to the camera. The strongest point
// light and the strongest spot light can be left to the contact shadow pass; they are only named
// here. [survey 5.3.1]
#include "hit_lighting.hlsli"
#include "light_reach.hlsli"

RWTexture2D<float4> direct : register(u0, space3);       // radiance
RWTexture2D<uint2> strongest : register(u1, space3);     // point light, spot light; kNoLight: none

static const uint kNoLight = 0xFFFFFF;  // exact when stored as a float

struct DirectConstants {
  uint leave_out_strongest;  // MainLighting
  uint combination;          // AddStrongest: kProduct, kMinimum, kAlone
  uint by_frustum;           // MainLighting: 1 lights_in_view in place of the clusters
};
ConstantBuffer<DirectConstants> constants : register(b0, space3);

// How a light's shadow map and its contact shadow are joined.
static const uint kProduct = 0, kMinimum = 1, kAlone = 2;

// The lights that reach into the picture: how many, and then their numbers, rising.
RWStructuredBuffer<uint> lights_in_view : register(u4, space3);

groupshared uint g_in_view[64];

// One group. In rising order, so that a sum over these lights adds in the order of a sum over all.
[shader("compute")]
[numthreads(8, 8, 1)]
void CullByFrustum(uint thread : SV_GroupIndex) {
  uint count = 0;
  for (uint first = 0; first < frame.light_count; first += 64) {
    const uint light = first + thread;
    g_in_view[thread] =
        light < frame.light_count && ReachesPicture(SafeReachOf(lights[light])) ? 1 : 0;
    GroupMemoryBarrierWithGroupSync();
    if (thread == 0) {
      for (uint i = 0; i < 64; ++i) {
        if (g_in_view[i] != 0) lights_in_view[++count] = first + i;
      }
    }
    GroupMemoryBarrierWithGroupSync();
  }
  if (thread == 0) lights_in_view[0] = count;
}

BrdfView PixelView(uint2 pixel, Brdf brdf) {
  return MakeBrdfView(brdf, OctahedralDecode(g_shading_normal[pixel]),
                      -SeenAlong(g_position[pixel].xyz));
}

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
  const BrdfView view = PixelView(pixel, brdf);
  const bool by_frustum = constants.by_frustum != 0;
  ClusterRange range;
  if (by_frustum) {
    range.count = lights_in_view[0];
    range.first = 0;
  } else {
    range = ClusterLights(position);
  }

  // Reads each light's shadow map once: the strongest light of a kind so far stays out of the sum,
  // and is added when a stronger one replaces it.
  uint2 best = uint2(kNoLight, kNoLight);
  float3 best_radiance[2] = {float3(0, 0, 0), float3(0, 0, 0)};
  float3 sum = float3(0, 0, 0);
  for (uint i = 0; i < range.count; ++i) {
    uint light = by_frustum ? lights_in_view[1 + i] : ClusterLight(range, i);
    const uint kind = lights[light].is_spot;
    float3 radiance = LightRadiance(lights[light], brdf, view, position);
    if (!(RadianceLuminance(radiance) > 0.0)) continue;
    if (RadianceLuminance(radiance) > RadianceLuminance(best_radiance[kind])) {
      const uint weaker = best[kind];
      const float3 weaker_radiance = best_radiance[kind];
      best[kind] = light;
      best_radiance[kind] = radiance;
      light = weaker;
      radiance = weaker_radiance;
      if (light == kNoLight) continue;
    }
    sum += radiance * ShadowMapVisibility(light, lights[light], position, geometric_normal);
  }
  if (constants.leave_out_strongest == 0) {
    for (uint kind = 0; kind < 2; ++kind) {
      const uint light = best[kind];
      if (light == kNoLight) continue;
      sum += best_radiance[kind] *
             ShadowMapVisibility(light, lights[light], position, geometric_normal);
    }
  }
  direct[pixel] = float4(sum, 1.0);
  strongest[pixel] = best;
}

RWTexture2D<float4> contact : register(u2, space3);  // visibility; r: point light, g: spot light
RWTexture2D<float4> total : register(u3, space3);

// Adds the two lights that were left out, with shadow map times contact shadow [Control: section
// 5.3.1], which counts a penumbra that both see twice, with the darker of the two, or with a shadow
// that needs no map.
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
    const BrdfView view = PixelView(pixel, brdf);
    for (uint kind = 0; kind < 2; ++kind) {
      const uint light = strongest[pixel][kind];
      if (light == kNoLight) continue;
      const float near = contact[pixel][kind];
      const float3 radiance = LightRadiance(lights[light], brdf, view, position);
      if (constants.combination == kAlone) {
        sum += near * radiance;
        continue;
      }
      const float far = ShadowMapVisibility(light, lights[light], position, geometric_normal);
      sum += constants.combination == kMinimum ? min(near, far) * radiance
                                               : near * (radiance * far);
    }
  }
  total[pixel] = float4(sum, 1.0);
}
