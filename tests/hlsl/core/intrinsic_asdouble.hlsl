// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic asdouble and asuint of double
// EXPECT f32 0 1.5
// EXPECT u32 4 0
// EXPECT u32 8 1074266112
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  double d = asdouble(0 + z, 0x3ff80000);
  results.Store(0, asuint((float)d));
  uint low, high;
  asuint(d * 2, low, high);
  results.Store2(4, uint2(low, high));
}
