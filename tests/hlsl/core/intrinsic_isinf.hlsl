// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic isinf
// EXPECT u32 0 1
// EXPECT u32 4 1
// EXPECT u32 8 0
// EXPECT u32 12 0
// EXPECT u32 16 0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const float inf = asfloat(0x7f800000 + z);
  results.Store4(0, (uint4)isinf(float4(inf, -inf, inf - inf, asfloat(0x7f7fffff + z))));
  results.Store(16, isinf(1.0 + z));
}
