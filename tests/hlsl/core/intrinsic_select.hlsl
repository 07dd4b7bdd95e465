// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic select
// EXPECT u32 0 2
// EXPECT f32 4 4.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(select(z == 0, 2u, 3u)));
  results.Store(4, asuint(select(bool2(true, false), float2(1, 2), float2(3, 4)).y));
}
