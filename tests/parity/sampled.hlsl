// SPDX-License-Identifier: MIT
// A texture with two texels, sampled between them.

Texture2D<float4> g_texture : register(t0);
SamplerState g_sampler : register(s0);
RWStructuredBuffer<float> g_values : register(u0);

[shader("raygeneration")]
void Sample() {
  const uint count = DispatchRaysDimensions().x;
  const float weight = (float(DispatchRaysIndex().x) + 0.5f) / float(count);
  g_values[DispatchRaysIndex().x] =
      g_texture.SampleLevel(g_sampler, float2(0.25f + 0.5f * weight, 0.5f), 0.0f).x;
}
