// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic distance
// EXPECT f32 0 5.0 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(distance(float2(1, 1) + z, float2(4, 5))));
}
