// SPDX-License-Identifier: MIT
// FEATURE: core bit fields
// EXPECT u32 0 2
// EXPECT u32 4 4
// EXPECT u32 8 19
// EXPECT u64 16 90194313236
// EXPECT u32 24 6
// EXPECT u32 28 1
// EXPECT u32 32 5
// EXPECT i32 36 -3
// EXPECT u32 40 9
// EXPECT u32 44 0x00000FF5
// EXPECT u32 48 3
// EXPECT i32 52 -8
// EXPECT u32 56 15
// EXPECT u32 60 1
// EXPECT u32 64 24
// EXPECT u32 68 4
// EXPECT u32 72 6
// EXPECT u32 76 5
// EXPECT u32 80 0xABCD0123
// EXPECT u32 84 0x00000007
// EXPECT u32 88 7
// EXPECT u32 92 12
RWByteAddressBuffer results : register(u0);

enum Kind { kFirst, kSecond, kThird };

// Fields of one size share a word as long as all their bits fit; 64 bits begin a new one.
struct Layout {
  uint a : 2;
  uint b : 6;
  uint c : 28;
  Kind kind : 3;
  int64_t wide : 40;
  uint last : 3;
};
StructuredBuffer<Layout> elements : register(t0);  // word i is i
cbuffer Constants : register(b0) {
  uint before;
  Layout constant;  // at 16
};

struct Packed {
  uint low : 12;
  uint : 4;
  uint high : 16;
  int next : (1 + 2);
  uint : 0;
  uint own : 5;
};
RWStructuredBuffer<Packed> stored : register(u1);

struct Small {
  int s : 4;
  uint u : 4;
  bool flag : 1;
  Kind kind : 2;
  void add(uint value) { u += value; }
};
groupshared Small shared_small;

uint sum(Small small) { return small.s + small.u + small.kind; }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const Layout element = elements[3 + z];
  results.Store(0, element.a);
  results.Store(4, elements[3 + z].b);
  results.Store(8, element.c);
  results.Store<int64_t>(16, element.wide);
  results.Store(24, elements[3 + z].last);
  results.Store(28, sizeof(Layout) == 24 && sizeof(Packed) == 12 && sizeof(Small) == 4 ? 1 : 0);
  results.Store(32, constant.c + (uint)constant.wide - 6);
  Small small = {5 + z, 21, z == 0, kThird};  // cut to 4 bits: 5 and 5
  small.s = 13;                               // 0b1101
  results.Store(36, small.s);
  small.add(4);
  results.Store(40, small.u);
  small.u -= 10;  // wraps in 4 bits
  results.Store(44, 0xFE6 + small.u);
  small.kind = (Kind)(7 + z);
  results.Store(48, small.kind);
  small.s = 7;
  ++small.s;
  results.Store(52, small.s);
  results.Store(56, small.u);
  results.Store(60, small.flag);
  shared_small = small;
  shared_small.u = 7;
  results.Store(64, shared_small.u++ + shared_small.u + 9 * shared_small.flag);
  results.Store(68, sum(shared_small) + 1);
  stored[1].low = 0x123;
  stored[1].high = 0xABCD;
  stored[1].next = 7 + z;
  stored[1].own = 38;  // 6 in 5 bits
  results.Store(72, stored[1].own);
  stored[1].own--;
  results.Store(76, stored[1 + z].own);
  const Packed read = stored[1];
  results.Store(80, (read.high << 16) | read.low);
  results.Store(84, (uint)read.next & 7);
  const uint2 pair = uint2(read.own.x, read.own.xx.y) + uint2(z, 2);
  results.Store(88, pair.y);
  Packed list[2] = {1, 2, 3, 4, 5, 6, 7 + z, 8};
  results.Store(92, list[1].low + list[0].own + list[0].next);
}
