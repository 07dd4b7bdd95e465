// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic ceil
// EXPECT f32 0 2.0
// EXPECT f32 4 -1.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(ceil(1.25 + z)));
  results.Store(4, asuint(ceil(-1.5)));
}
