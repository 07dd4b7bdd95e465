// SPDX-License-Identifier: MIT
// FEATURE: core single comp assign v.x =
// EXPECT f32 0 1.0
// EXPECT f32 4 4.0
// EXPECT f32 8 3.0
// EXPECT f32 12 4.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float4 v = 0;
  v.x = 1 + z;
  v.w = 4;
  v.y += v.w;
  v[2] = 3;
  results.Store4(0, asuint(v));
}
