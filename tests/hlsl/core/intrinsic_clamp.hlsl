// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic clamp
// EXPECT u32 0 3
// EXPECT f32 4 -1.0
// EXPECT u32 8 5
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(clamp(5 + (int)z, 0, 3)));
  results.Store(4, asuint(clamp(-1.5 + z, -1, 1)));
  results.Store(8, asuint(clamp(7u, 2, 5)));
}
