// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic msad4
// EXPECT u32 0 5
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(msad4(0x01020304 + z, uint2(0x01020304, 0), uint4(5, 6, 7, 8)).x));
}
