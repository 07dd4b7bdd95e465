// SPDX-License-Identifier: MIT
// FEATURE: core ternary ?:
// EXPECT u32 0 3
// EXPECT f32 4 4.0
// EXPECT f32 8 5.0
// EXPECT f32 12 6.0
// EXPECT f32 16 2.5
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint a = z == 0 ? 3 : 4;
  float3 b = a > 3 ? float3(1, 2, 3) : float3(4, 5, 6);
  results.Store(0, a);
  results.Store3(4, asuint(b));
  results.Store(16, asuint(z ? 1 : 2.5));
}
