// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic min
// EXPECT f32 0 1.5
// EXPECT i32 4 -3
// EXPECT u32 8 4
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(min(1.5 + z, 2)));
  results.Store(4, asuint(min(-3, 2)));
  results.Store(8, asuint(min(uint2(3, 9), 4).y));
}
