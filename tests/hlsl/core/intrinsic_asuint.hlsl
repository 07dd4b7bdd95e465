// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic asuint
// EXPECT u32 0 1065353216
// EXPECT u32 4 4294967295
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(asuint(1.0 + z)));
  results.Store(4, asuint(asuint(int2(-1, 0)).x));
}
