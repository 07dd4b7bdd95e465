// SPDX-License-Identifier: MIT
// FEATURE: core scalar swizzle 1.0.xxx / f.xxx
// EXPECT f32 0 2.5
// EXPECT f32 4 2.5
// EXPECT f32 8 2.5
// EXPECT f32 12 2.5
// EXPECT f32 16 2.5
// EXPECT f32 20 2.5
// EXPECT u32 24 3
// EXPECT u32 28 3
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float f = 2.5 + z;
  results.Store3(0, asuint(f.xxx));
  results.Store3(12, asuint(1.0.xxx * f));
  results.Store2(24, 3u.xx);
}
