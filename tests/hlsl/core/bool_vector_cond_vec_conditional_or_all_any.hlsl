// SPDX-License-Identifier: MIT
// FEATURE: core bool vector cond (vec ?: or all/any)
// EXPECT u32 0 1
// EXPECT u32 4 0
// EXPECT u32 8 1
// EXPECT f32 12 1.0
// EXPECT f32 16 0.0
// EXPECT f32 20 2.0
// EXPECT u32 24 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float3 v = float3(1, -1, 2) + z;
  bool3 positive = v > 0;
  results.Store(0, any(positive));
  results.Store(4, all(positive));
  results.Store(8, all(v > -5));
  results.Store3(12, asuint(select(positive, v, 0.0)));
  results.Store(24, any(v == 2));
}
