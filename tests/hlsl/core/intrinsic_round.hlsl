// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic round
// EXPECT f32 0 2.0
// EXPECT f32 4 4.0
// EXPECT f32 8 -1.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(round(2.5 + z)));
  results.Store(4, asuint(round(3.5)));
  results.Store(8, asuint(round(-1.2)));
}
