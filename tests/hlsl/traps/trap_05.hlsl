// SPDX-License-Identifier: MIT
// TRAP: 5 implicit conversions
// EXPECT f32 0 3.0
// EXPECT f32 4 2.0
// EXPECT u32 8 3
// EXPECT u32 12 0
// EXPECT u32 16 2
// EXPECT u32 20 2
// EXPECT u32 24 5
// EXPECT f32 28 0.5
float f(float3 x) { return x.z; }
uint g(uint x) { return x; }
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float4 long_vector = float4(1, 2, 3, 4) + z;
  results.Store(0, asuint(f(long_vector)));
  results.Store(4, asuint(f(2)));
  results.Store(8, g(3.9 + z));
  int a = -1;
  uint b = 1;
  results.Store(12, a < b ? 1u : 0u);
  results.Store(16, asuint(max(a, 2)));
  bool c = 7;
  results.Store(20, c + 1);
  uint values[3] = {4, 5, 6};
  results.Store(24, values[1.5 + z]);
  results.Store(28, asuint(lerp(float3(0, 0, 0), 1, 0.5).y));
}
