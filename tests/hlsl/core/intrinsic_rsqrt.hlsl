// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic rsqrt
// EXPECT f32 0 0.5 2
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(rsqrt(4.0 + z)));
}
