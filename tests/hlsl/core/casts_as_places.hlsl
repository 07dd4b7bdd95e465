// SPDX-License-Identifier: MIT
// FEATURE: core casts as places
// EXPECT f32 0 11
// EXPECT f32 4 21
// EXPECT f32 8 3
// EXPECT f32 12 4
// EXPECT f32 16 3
// EXPECT f32 20 6
// EXPECT i32 24 -2
// EXPECT f32 28 8
// EXPECT f32 32 5
// EXPECT f32 36 2
// EXPECT u32 40 1
// EXPECT f32 44 7
RWByteAddressBuffer results : register(u0);
RWStructuredBuffer<float4> stored : register(u1);

void put(out float2 v) { v = float2(10, 20); }
void add(inout float2 v) { v += 1; }
void whole(inout int i) { i += 4; }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  // What the cast leaves out keeps its value.
  float4 p = float4(1, 2, 3, 4 + z);
  put((float2)p);
  add((float2)p);
  results.Store4(0, asuint(p));
  float2 q = float2(5, 6 + z);
  (float)q = 1;
  (float)q += 2;
  results.Store2(16, asuint(q));
  int n = -3 - (int)z;
  ((uint)n)++;
  results.Store(24, n);
  float f = 2.75 + z;
  (int)f = 7.9;
  ++((int)f);
  results.Store(28, asuint(f));
  // The place is evaluated once.
  uint i = z;
  float2 list[2] = {1, 2, 3, 4};
  (float)list[i++] = 5;
  results.Store(32, asuint(list[0].x));
  results.Store(36, asuint(list[0].y));
  results.Store(40, i);
  stored[1].y = 3.5;
  whole((int)stored[1 + z].y);
  results.Store(44, asuint(stored[1].y));
}
