// SPDX-License-Identifier: MIT
// FEATURE: core matrix (bare keyword = float4x4)
// EXPECT f32 0 1.0
// EXPECT f32 4 2.0
// EXPECT f32 8 3.0
// EXPECT f32 12 4.0
// EXPECT f32 16 9.0
// EXPECT f32 20 14.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  matrix m = (matrix)0;
  m[1] = float4(1, 2, 3, 4);
  m._m33 = 9 + z;
  results.Store4(0, asuint(m[1]));
  results.Store(16, asuint(m[3][3]));
  matrix<float, 2, 3> n = {1, 2, 3, 4, 5, 6};
  vector<float, 2> v = {7, 8};
  vector w = 1;
  results.Store(20, asuint(n[1].y + v.y + w.w));
}
