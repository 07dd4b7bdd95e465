// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic floor
// EXPECT f32 0 -2.0
// EXPECT f32 4 -1.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(floor(-1.5 + z)));
  results.Store(4, asuint(floor(float2(1.9, -0.1)).y));
}
