// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic max
// EXPECT f32 0 2.0
// EXPECT i32 4 2
// EXPECT u32 8 4
// EXPECT f32 12 3.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(max(1.5 + z, 2)));
  results.Store(4, asuint(max(-3, 2)));
  results.Store(8, asuint(max(3u, 4)));
  results.Store(12, asuint(max(float2(1, 5), 3).x));
}
