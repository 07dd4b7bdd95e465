// SPDX-License-Identifier: MIT
// FEATURE: core arrays in other shapes
// EXPECT f32 0 8
// EXPECT f32 4 21
// EXPECT f32 8 87
// EXPECT f32 12 9
// EXPECT f32 16 8
// EXPECT f32 20 4
// EXPECT f32 24 50
// EXPECT f32 28 6
// EXPECT f32 32 3
// EXPECT f32 36 42
// EXPECT u32 40 16
RWByteAddressBuffer results : register(u0);

static const float kFlat[4] = {1, 2, 3, 4};
static const float kNested[2][2] = kFlat;
static const float kCopy[] = kFlat;

float last(float a[2][3]) { return a[1][2] + a[0][1]; }
// The size is that of what is passed.
float sum(float a[]) { return a[0] + a[1] * 10; }
void fill(inout float a[]) { a[1] = 9; }
void change(inout float2 a[3]) { a[2].x = 50; }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float v[6] = {1, 2, 3, 4, 5, 6 + z};
  results.Store(0, asuint(last(v)));
  results.Store(4, asuint(sum(v)));
  float w[2] = {7, 8 + z};
  results.Store(8, asuint(sum(w)));
  fill(w);
  results.Store(12, asuint(w[1]));
  float4 a[2] = {1, 2, 3, 4, 5, 6, 7, 8 + z};
  float4 b[] = a;
  results.Store(16, asuint(b[1 + z].w));
  const float4 c[] = v[0] == 1 ? a : b;
  results.Store(20, asuint(c[z].w));
  change(v);
  results.Store(24, asuint(v[4]));
  results.Store(28, asuint(v[5]));
  results.Store(32, asuint(kNested[1 + z][0]));
  const float grid[2][3] = v;
  results.Store(36, asuint(grid[0][1] + kCopy[3 + z] * 10));
  results.Store(40, sizeof(kCopy));
}
