// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic sign
// EXPECT i32 0 -1
// EXPECT i32 4 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(sign(-2.5 + z)));
  results.Store(4, asuint(sign(int2(0, 7)).y));
}
