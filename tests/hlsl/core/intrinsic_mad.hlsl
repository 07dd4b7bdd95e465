// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic mad
// EXPECT f32 0 10.0
// EXPECT u32 4 10
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(mad(2.0 + z, 3.0, 4.0)));
  results.Store(4, asuint(mad(2u, 3u, 4u)));
}
