// SPDX-License-Identifier: MIT
// FEATURE: compute implicit levels of detail
// A thread is a texel of mip 0, or two: then mip 1 is read, whose z is 1.
// EXPECT f32 0 0 0 0 0 0 0 0 0
// EXPECT f32 32 1 1 1 1 1 1 1 1
// EXPECT f32 64 1 1 1 1 1 1 1 1
// The x of mip 1 is not above 1.5 times the thread's, that of mip 0 is.
// EXPECT f32 96 0 0 0 0 0 0 0 0
// EXPECT f32 128 0 1 1 1 0 1 1 1
// EXPECT f32 160 1 1 1 1 1 1 1 1
// EXPECT f32 192 2 2 2 2 2 2 2 2
// The condition does not change the level.
// EXPECT f32 224 0 1 0 1 0 1 0 1
Texture2D<float4> image : register(t0);
SamplerState point_sampler : register(s0);
SamplerComparisonState comparison : register(s1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 2, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  const float2 at = id.xy + results.Load(65532);
  const float2 texel = (at + 0.5) / 8;
  const float2 two = (at * 2 + 0.5) / 8;
  results.Store(4 * i, asuint(image.Sample(point_sampler, texel).z));
  results.Store(32 + 4 * i, asuint(image.Sample(point_sampler, two).z));
  results.Store(64 + 4 * i, asuint(image.SampleBias(point_sampler, texel, 1).z));
  results.Store(96 + 4 * i, asuint(image.SampleCmp(comparison, two, 1.5 * at.x)));
  results.Store(128 + 4 * i, asuint(image.SampleCmpLevelZero(comparison, two, 1.5 * at.x)));
  results.Store(160 + 4 * i, asuint(image.CalculateLevelOfDetail(point_sampler, at / 2)));
  results.Store(192 + 4 * i, asuint(image.CalculateLevelOfDetailUnclamped(point_sampler, at / 2)));
  if (id.x & 1) results.Store(224 + 4 * i, asuint(image.Sample(point_sampler, two).z));
}
