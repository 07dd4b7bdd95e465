// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic abs
// EXPECT f32 0 2.5
// EXPECT u32 4 3
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(abs(-2.5 + z)));
  results.Store(4, asuint(abs(-3 + (int)z)));
}
