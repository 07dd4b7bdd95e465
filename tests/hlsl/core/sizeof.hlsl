// SPDX-License-Identifier: MIT
// FEATURE: core sizeof
// EXPECT u32 0 4
// EXPECT u32 4 64
// EXPECT u32 8 24
// EXPECT u32 12 12
// EXPECT u32 16 8
struct Item {
  float3 a;
  uint b;
  double c;
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store4(0, uint4(sizeof(float), sizeof(float4x4), sizeof(Item), sizeof(uint[3])));
  float2 v = z;
  results.Store(16, sizeof(v));
}
