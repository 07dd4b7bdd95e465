// SPDX-License-Identifier: MIT
// FEATURE: extended structured buffers with strides of 2, 6, 10 and 26 bytes
// OPTIONS: -enable-16bit-types
// EXPECT u32 0 3 0 3 0 4
// EXPECT u32 20 5 0 6 0 7
// EXPECT u32 40 13 19 0
// EXPECT u32 52 7 8 9 0
// EXPECT u32 68 3 0 4
// EXPECT u32 80 6 10 26
RWByteAddressBuffer results : register(u0);
struct Five { uint16_t a[5]; };
struct Thirteen { uint16_t3 a; half b; uint16_t c[9]; };
StructuredBuffer<uint16_t> two : register(t1);
StructuredBuffer<uint16_t3> six : register(t2);
StructuredBuffer<Five> ten : register(t3);
StructuredBuffer<Thirteen> twenty_six : register(t4);
RWStructuredBuffer<uint16_t3> written : register(u1);
StructuredBuffer<uint16_t3> views[2] : register(t5);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  // Word i of each buffer is i, so halfword 2 i is i.
  results.Store2(0, uint2(two[6 + z], two[7 + z]));
  results.Store3(8, uint3(six[2 + z]));
  const Five five = ten[2 + z];
  for (uint i = 0; i < 5; ++i) results.Store(20 + 4 * i, five.a[i]);
  const Thirteen thirteen = twenty_six[2 + z];
  results.Store2(40, uint2(thirteen.a.x, thirteen.c[8]));
  results.Store(48, thirteen.a.y);
  written[z + 1] = uint16_t3(7, 8, 9);
  results.Store3(52, uint3(written[1]));
  results.Store(64, uint(written[0].y));  // is not touched
  results.Store3(68, uint3(views[1][2 + z]));
  uint count, stride;
  views[0].GetDimensions(count, stride);
  results.Store3(80, uint3(stride, sizeof(Five), sizeof(Thirteen)));
}
