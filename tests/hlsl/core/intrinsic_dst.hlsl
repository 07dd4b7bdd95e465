// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic dst
// EXPECT f32 0 10.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(dst(float4(0, 2, 3, 4) + z, float4(0, 5, 6, 7)).y));
}
