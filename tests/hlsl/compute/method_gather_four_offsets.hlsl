// SPDX-License-Identifier: MIT
// FEATURE: compute .GatherRed to .GatherAlpha with four offsets, clamps of implicit samples
// Component i comes from what the gather at offset i would return.
// EXPECT f32 0 4 3 6 3
// EXPECT f32 16 5 3 5 3
// EXPECT f32 32 4 3 6 3
// EXPECT u32 48 1
// The clamp of a sample is the lowest level that it may use.
// EXPECT f32 52 2 2 1
// EXPECT f32 64 3 2 1
Texture2D<float4> image : register(t0);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const float2 uv = 0.5 + z;
  results.Store4(0, asuint(image.GatherRed(point_sampler, uv, int2(1, 0), int2(-1, 0), int2(2, 0),
                                           int2(0, 0))));
  results.Store4(16, asuint(image.GatherGreen(point_sampler, uv, int2(0, 1), int2(0, -1),
                                              int2(0, 2), int2(0, 0))));
  uint status = z;
  results.Store4(32, asuint(image.GatherRed(point_sampler, uv, int2(1, 0), int2(-1, 0), int2(2, 0),
                                            int2(0, 0), status)));
  results.Store(48, status);
  results.Store3(52, asuint(image.Sample(point_sampler, uv, int2(0, 0), 1.0 + z).xyz));
  results.Store3(64, asuint(image.Sample(point_sampler, uv, int2(1, 0), 1.0 + z, status).xyz));
}
