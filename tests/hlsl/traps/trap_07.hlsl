// SPDX-License-Identifier: MIT
// TRAP: 7 copy-in and copy-out
// EXPECT u32 0 11
// EXPECT f32 4 3.0
// EXPECT u32 8 11
// EXPECT u32 12 2
// EXPECT u32 16 3
// EXPECT u32 20 5
// EXPECT u32 24 10
// EXPECT u32 28 22
// EXPECT f32 32 1.0
// EXPECT f32 36 6.0
// EXPECT u32 40 0
// EXPECT u32 44 1
// EXPECT u32 48 0
// EXPECT u32 52 11
// EXPECT u32 56 103
// EXPECT u32 60 3
void both(inout uint a, inout uint b) {
  a += 1;
  b += 10;
}
void half_way(inout int x) { x = x / 2; }
RWStructuredBuffer<uint4> buffer : register(u1);
RWTexture2D<float4> image : register(u2);
void raise(inout float x) { x += 5; }
struct Pair {
  uint first;
  float3 second;
};
Pair make_pair(uint x) {
  Pair pair;
  pair.first = x;
  pair.second = float3(x, 2, 3);
  return pair;
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint x = 1 + z;
  both(x, x);
  results.Store(0, x);
  float f = 7.5;
  half_way(f);
  results.Store(4, asuint(f));
  uint4 v = uint4(1, 2, 3, 4);
  both(v.w, v.x);
  results.Store4(8, v);
  both(buffer[2].y, buffer[3].x);
  results.Store2(24, uint2(buffer[2].y, buffer[3].x));
  image[uint2(2, 3)] = 1;
  raise(image[uint2(2, 3)].z);
  results.Store2(32, asuint(image[uint2(2, 3)].yz));
  uint a[3] = {0, 0, 0};
  uint i = 1;
  both(a[i], i);
  results.Store4(40, uint4(a[0], a[1], a[2], i));
  Pair pair = make_pair(3 + z);
  const Pair copy = pair;  // a copy, not another name for it
  pair.first += 100;
  results.Store2(56, uint2(pair.first, copy.first));
}
