// SPDX-License-Identifier: MIT
// FEATURE: extended .SampleCmpGrad, .SampleCmpBias and the clamp of .SampleGrad
// A thread is two texels of mip 0, so the quad's level is 1. In mip 0 the texel's x is above 1.5 times the thread's
// where that is not 0; in mip 1 it is not. .SampleCmpBias with -1, and with 0:
// EXPECT f32 0 0 1 1 1 0 1 1 1
// EXPECT f32 32 0 0 0 0 0 0 0 0
// .SampleCmpGrad of one texel, of two, and of one with the clamp 1:
// EXPECT f32 64 0 1 1 1 0 1 1 1
// EXPECT f32 96 0 0 0 0 0 0 0 0
// EXPECT f32 128 0 0 0 0 0 0 0 0
// .SampleGrad of one texel (z is the mip) with the clamps 0, 1 and, of two texels, 0:
// EXPECT f32 160 0 0 0 0 0 0 0 0
// EXPECT f32 192 1 1 1 1 1 1 1 1
// EXPECT f32 224 1 1 1 1 1 1 1 1
// An offset of (1, 0), a clamp and a status:
// EXPECT f32 256 1 2 3 3 1 2 3 3
// EXPECT u32 288 1 1 1 1 1 1 1 1
Texture2D<float4> image : register(t0);
SamplerState point_sampler : register(s0);
SamplerComparisonState comparison : register(s1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 2, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  const float2 at = id.xy + results.Load(65532);
  const float2 two = (at * 2 + 0.5) / 8;
  const float value = 1.5 * at.x;
  const float2 x = float2(0.125, 0);
  const float2 y = float2(0, 0.125);
  const int2 none = int2(0, 0);
  results.Store(4 * i, asuint(image.SampleCmpBias(comparison, two, value, -1)));
  results.Store(32 + 4 * i, asuint(image.SampleCmpBias(comparison, two, value, 0, none)));
  results.Store(64 + 4 * i, asuint(image.SampleCmpGrad(comparison, two, value, x, y)));
  results.Store(96 + 4 * i, asuint(image.SampleCmpGrad(comparison, two, value, 2 * x, y, none)));
  results.Store(128 + 4 * i, asuint(image.SampleCmpGrad(comparison, two, value, x, y, none, 1)));
  results.Store(160 + 4 * i, asuint(image.SampleGrad(point_sampler, two, x, y, none, 0).z));
  results.Store(192 + 4 * i, asuint(image.SampleGrad(point_sampler, two, x, y, none, 1).z));
  results.Store(224 + 4 * i, asuint(image.SampleGrad(point_sampler, two, 2 * x, y, none, 0).z));
  uint status;
  results.Store(256 + 4 * i, asuint(image.SampleGrad(point_sampler, two, x, y, int2(1, 0), 1, status).x));
  results.Store(288 + 4 * i, CheckAccessFullyMapped(status) ? 1 : 0);
}
