// SPDX-License-Identifier: MIT
// An effect for the registry's test: what sees the sky straight above glows.
#include "visibility.hlsli"

struct ToyConstants {
  float strength;  // radiance of what glows
};
ConstantBuffer<ToyConstants> toy : register(b0, space3);
RWTexture2D<float4> toy_sum : register(u0, space3);

[shader("raygeneration")]
void ToyRayGen() {
  const uint2 pixel = FramePixel();
  float open = 0.0;
  if (g_ids[pixel].x != 0) {
    const float4 position = g_position[pixel];
    const float3 origin = position.xyz + OctahedralDecode(g_normal[pixel]) * position.w;
    open = TraceVisibility(origin, float3(0, 1, 0), kLongestRay);
  }
  toy_sum[pixel] = SumBefore(toy_sum, pixel) + open * float(pass_constants.sample_count);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void ToyCompose(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  radiance.GetDimensions(width, height);
  if (id.x >= width || id.y >= height) return;
  radiance[id.xy] += float4(toy.strength * toy_sum[id.xy].rgb, 0.0);
}

// The same question answered by passes of its own, without a ray.
[shader("compute")]
[numthreads(8, 8, 1)]
void ToyFacing(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  radiance.GetDimensions(width, height);
  if (id.x >= width || id.y >= height || g_ids[id.xy].x == 0) return;
  toy_sum[id.xy] = toy.strength * saturate(OctahedralDecode(g_normal[id.xy]).y);
}
