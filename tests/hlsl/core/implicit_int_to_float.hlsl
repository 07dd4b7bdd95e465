// SPDX-License-Identifier: MIT
// FEATURE: core implicit int→float in vector op (uint2 + 0.5)
// EXPECT f32 0 0.4375
// EXPECT f32 4 0.5625
// EXPECT f32 8 0.5
// EXPECT f32 12 1.0
// EXPECT f32 16 1.5
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint2 index = uint2(3, 4) + z;
  float2 center = index + 0.5;
  results.Store2(0, asuint(center / 8));
  int3 a = int3(1, 2, 3);
  results.Store3(8, asuint(a * 0.5));
}
