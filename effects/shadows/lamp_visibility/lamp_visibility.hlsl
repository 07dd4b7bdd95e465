// SPDX-License-Identifier: MIT
// Hard shadows of all local lights: a ray from each pixel to the centre of each light that shines on
// it, into a visibility buffer with a bit for each light, and the light of those that are seen.
// [survey 5.3]
#include "hit_lighting.hlsli"
#include "visibility.hlsli"

RWTexture2D<float4> light_seen : register(u0, space3);      // radiance
// Bit i: the i-th light of the pixel's cluster is visible.
RWTexture2D<uint4> visible_lights : register(u1, space3);

static const uint kBits = 128;  // of a pixel; of lights past these the shadow maps tell

bool IsVisible(LightConstants light, float3 position, float3 normal, float offset) {
  const float3 to_center = light.position - position;
  const float distance = length(to_center);
  if (!(distance > light.radius)) return true;
  const float3 direction = to_center / distance;
  if (!(dot(direction, normal) > 0.0)) return false;
  // The lamp's own surface must not shadow it.
  return TraceVisibility(position + normal * offset, direction, distance - light.radius) > 0.0;
}

BrdfView PixelView(uint2 pixel, Brdf brdf) {
  return MakeBrdfView(brdf, OctahedralDecode(g_shading_normal[pixel]),
                      -SeenAlong(g_position[pixel].xyz));
}

[shader("raygeneration")]
void LampVisibilityRayGen() {
  const uint2 pixel = FramePixel();
  uint4 bits = uint4(0, 0, 0, 0);
  if (g_ids[pixel].x != 0) {
    const Brdf brdf = PixelBrdf(pixel);
    const BrdfView view = PixelView(pixel, brdf);
    const float4 position = g_position[pixel];
    const float3 normal = OctahedralDecode(g_normal[pixel]);
    const ClusterRange range = ClusterLights(position.xyz);
    for (uint i = 0; i < min(range.count, kBits); ++i) {
      const LightConstants light = lights[ClusterLight(range, i)];
      // Most lights of a cluster do not reach the pixel.
      const float3 radiance = LightRadiance(light, brdf, view, position.xyz);
      if (!(RadianceLuminance(radiance) > 0.0)) continue;
      if (IsVisible(light, position.xyz, normal, position.w)) bits[i >> 5] |= 1u << (i & 31u);
    }
  }
  visible_lights[pixel] = bits;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void LightByVisibility(uint3 id : SV_DispatchThreadID) {
  const uint2 pixel = id.xy;
  uint2 size;
  light_seen.GetDimensions(size.x, size.y);
  if (any(pixel >= size)) return;
  float3 sum = float3(0, 0, 0);
  if (g_ids[pixel].x != 0) {
    const Brdf brdf = PixelBrdf(pixel);
    const BrdfView view = PixelView(pixel, brdf);
    const float3 position = g_position[pixel].xyz;
    const float3 normal = OctahedralDecode(g_normal[pixel]);
    const ClusterRange range = ClusterLights(position);
    const uint4 bits = visible_lights[pixel];
    for (uint i = 0; i < range.count; ++i) {
      const uint light = ClusterLight(range, i);
      if (i >= kBits) {
        sum += ShadowedLightRadiance(light, brdf, view, position, normal);
      } else if ((bits[i >> 5] >> (i & 31u) & 1u) != 0) {
        sum += LightRadiance(lights[light], brdf, view, position);
      }
    }
  }
  light_seen[pixel] = float4(sum, 1.0);
}
