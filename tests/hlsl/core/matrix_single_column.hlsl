// SPDX-License-Identifier: MIT
// FEATURE: core matrices of one column or row
// EXPECT f32 0 2
// EXPECT f32 4 7
// EXPECT f32 8 3
// EXPECT f32 12 5
// EXPECT f32 16 9
// EXPECT f32 20 6
// EXPECT f32 24 11
// EXPECT u32 28 12
// EXPECT f32 32 8
// EXPECT f32 36 4
// EXPECT u32 40 21
// EXPECT f32 44 13
RWByteAddressBuffer results : register(u0);

struct Columns {
  float3x1 f;
  row_major float2x1 r;
};
RWStructuredBuffer<Columns> stored : register(u1);

groupshared float2x1 shared_column;

void change(inout float one) { one += 4; }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float3x1 m = float3x1(1, 2, 3);
  results.Store(0, asuint(m[1 + z][0]));
  m[2][0] = 7;
  results.Store(4, asuint(m._m20 + z));
  m[z][z] = 3;
  results.Store(8, asuint(m[0].x));
  half3x1 h = half3x1(1, 5, 2);
  results.Store(12, asuint((float)h[1 + z][0]));
  change(m[1][0]);
  m[1 + z][0] += 3;
  results.Store(16, asuint(m[1][0]));
  const float1x3 row = float1x3(4, 5, 6);
  results.Store(20, asuint(row[0][2 + z]));
  stored[0].f = float3x1(10, 11, 12);
  stored[0].f[2 - z][0] = 11;
  stored[0].r[1][0] = 12;
  results.Store(24, asuint(stored[0].f[2][z]));
  results.Store(28, (uint)stored[0].r[1 + z][0]);
  float1 one = 8;
  results.Store(32, asuint(one[z]));
  vector<float, 1> two = 3;
  two[0] = 4;
  results.Store(36, asuint(two[0] + z));
  int1 list[2] = {20, 21};
  results.Store(40, list[1 + z][0]);
  shared_column[1][0] = 13;
  results.Store(44, asuint(shared_column[1 + z][0]));
}
