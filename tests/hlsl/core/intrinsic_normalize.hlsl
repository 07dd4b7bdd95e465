// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic normalize
// EXPECT f32 0 0.6 2
// EXPECT f32 4 -1.0 2
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(normalize(float3(3, 0, 4) + z).x));
  results.Store(4, asuint(normalize(float2(0, -2)).y));
}
