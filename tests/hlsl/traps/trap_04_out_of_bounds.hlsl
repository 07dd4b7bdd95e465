// SPDX-License-Identifier: MIT
// TRAP: 4 structured buffers are tight, raw loads ignore low bits
// BREAKS: KA0418
// EXPECT u32 0 254
// EXPECT u32 4 255
// EXPECT u32 8 0
// EXPECT u32 12 0
// EXPECT u32 16 0
// EXPECT u32 20 0
// EXPECT u32 24 0
// EXPECT u32 28 3
// EXPECT u32 32 0
// EXPECT u32 36 0
// EXPECT u32 40 5
// EXPECT u32 44 0
// EXPECT u32 48 0
// EXPECT u32 52 0
// EXPECT u64 56 38654705672
// EXPECT u32 64 10
// EXPECT u32 68 12
struct Pair {
  uint a;
  uint3 b;
};
struct Wide {
  uint a;
  uint64_t b;
  uint c;
};
ByteAddressBuffer bytes[2] : register(t0, space1);
RWByteAddressBuffer writable[2] : register(u0, space1);
StructuredBuffer<Pair> pairs[2] : register(t0, space2);
RWStructuredBuffer<Pair> out_pairs[2] : register(u0, space2);
Buffer<uint> words[2] : register(t0, space3);
RWBuffer<uint> out_words[2] : register(u0, space3);
StructuredBuffer<Wide> wide : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store4(0, bytes[z].Load4(1016));
  results.Store3(16, uint3(bytes[1].Load(1024), bytes[z].Load(0xfffffffc), pairs[1][64].b.x));
  results.Store(28, bytes[z].Load(13));
  writable[0].Store2(1020, uint2(7, 8));
  writable[0].Store(1 << 20, 9);
  out_pairs[1][64] = pairs[0][1];
  out_pairs[1][0xffffffff].b.z = 1;
  results.Store2(32, uint2(writable[0].Load(1024), out_pairs[1][64].a));
  out_words[1][256] = 4;
  out_words[1][5] += 0;
  results.Store2(40, uint2(words[0][5], words[1][256]));
  results.Store2(48, uint2(out_words[1][256], out_words[z][~z]));
  results.Store<uint64_t>(56, wide[1].b);  // stride 24: words 8 and 9
  results.Store2(64, uint2(wide[1].c, wide[2].a));
}
