// SPDX-License-Identifier: MIT
// FEATURE: core user overload of an intrinsic
// EXPECT f32 0 8 3 6 9
// EXPECT f32 16 5 7 1 2
// EXPECT u32 32 1 2 7
RWByteAddressBuffer results : register(u0);

float3 pow(float3 a, float b) { return a * b; }
float2 max(float2 a, float2 b) { return 7; }
uint asuint(float x) { return 7; }
float clamp(float x, float low, float high) { return 5; }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const float two = 2 + z;
  const uint3 v = uint3(1, 2, 3) + z;
  // The intrinsic's own, which converts nothing, beside a splat and a truncation.
  const float a = pow(two, 3.0), m = max(two, 0.5);
  const uint2 bits = asuint(half2(1 + z, 2));
  // The source's: exactly its parameters.
  const float3 b = pow(float3(v), 3.0);
  const float c = clamp(two, 0, 1), d = max(float2(two, two), float2(0, 0)).x;
  results.Store4(0, asint(float4(a, b)));
  results.Store4(16, asint(float4(c, d, max(1.0 + z, 0.5), m)));
  results.Store2(32, uint2(bits == asint(half2(1, 2))) * uint2(1, 2));
  results.Store(40, asuint(two));
}
