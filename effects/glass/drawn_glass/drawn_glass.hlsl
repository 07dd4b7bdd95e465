// SPDX-License-Identifier: MIT
// Glass by draws, from back to front, each layer blended over what is behind it. A layer whose depth
// is the one that a ray found before shows what that ray's mirror image holds; all others show an
// environment map. [Control; survey 6.5]
#include "drawn_layer.hlsli"

// The pictures that the draws leave.
Texture2D<float4> drawn_radiance : register(t3, space3);
Texture2D<float4> drawn_transmittance : register(t4, space3);

struct GlassPixel {
  float4 radiance : SV_Target0;       // w: 1 - transmittance, by which what is behind is covered
  float4 transmittance : SV_Target1;  // by colour
};

[shader("pixel")]
GlassPixel DrawnGlassPixel(GlassVertex vertex, uint primitive : SV_PrimitiveID) {
  const uint2 pixel = uint2(vertex.position.xy);
  const DrawnLayer layer = LayerOf(draws[constants.draw], pixel, primitive);
  if (!layer.is_seen) discard;
  const GlassLayer shaded = ShadeLayer(layer, first_mirrored[pixel]);
  const float open = RadianceLuminance(shaded.transmittance);
  GlassPixel result;
  result.radiance = float4(shaded.radiance, 1.0 - open);
  result.transmittance = float4(shaded.transmittance, open);
  return result;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void DrawnGlassResult(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  glass_radiance.GetDimensions(width, height);
  if (id.x >= width || id.y >= height) return;
  // Without rays nobody knows the depth of the first layer.
  const float first = constants.tolerance >= 0.0 ? first_mirrored[id.xy].w : 0.0;
  glass_radiance[id.xy] = float4(drawn_radiance[id.xy].rgb, first);
  glass_transmittance[id.xy] = float4(drawn_transmittance[id.xy].rgb, 0.0);
}
