// SPDX-License-Identifier: MIT
// FEATURE: core implicit scalar→vector init (floatN x = 0/1.0;)
// EXPECT f32 0 1.0
// EXPECT f32 4 1.0
// EXPECT f32 8 1.0
// EXPECT f32 12 2.0
// EXPECT u32 16 3
// EXPECT u32 20 3
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float3 a = 1.0;
  float4x4 m = 2 + z;
  uint2 b = 3;
  a += z;
  results.Store3(0, asuint(a));
  results.Store(12, asuint(m._m32));
  results.Store2(16, b);
}
