// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic f32tof16
// EXPECT u32 0 15360
// EXPECT u32 4 31743
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(f32tof16(1.0 + z)));
  results.Store(4, asuint(f32tof16(65504.0)));
}
