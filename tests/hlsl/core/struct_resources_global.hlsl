// SPDX-License-Identifier: MIT
// FEATURE: core global structs that hold resources
// EXPECT u32 0 3
// EXPECT u32 4 3
// EXPECT u32 8 0
// EXPECT u32 12 5
// EXPECT u32 16 4
// EXPECT u32 20 9
// EXPECT u32 24 2
// EXPECT u32 28 2
// EXPECT u32 32 9
// EXPECT u32 36 14
// EXPECT u32 40 17
RWByteAddressBuffer results : register(u0);

struct Source {
  ByteAddressBuffer words;
  uint first;
  uint get(uint index) { return words.Load(4 * (index + first)); }
};
struct Pair : Source {
  Buffer<uint> typed;
  uint4 last;
};

// $Globals: pair, whose register is an offset in rows too, with first at 0 and last at 16; behind it
// before at 32 and after at 36.
uint before;
Pair pair : register(t0);
uint after;
Source sources[2] : register(t0, space1);

cbuffer Block : register(b1) {
  uint pad;
  Pair inner;
  uint tail;
};

uint through(Source source, uint index) { return source.get(index); }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, pair.words.Load(12 + z));
  results.Store(4, pair.get(3));
  results.Store(8, pair.first);
  results.Store(12, pair.typed[5 + z]);
  results.Store(16, pair.last.x);
  results.Store(20, after);
  results.Store(24, sources[1].words.Load(8 + z));
  results.Store(28, through(pair, 2));
  const Pair copy = pair;
  results.Store(32, copy.get(9) + z);
  Source local = copy;
  local.first = 13;
  results.Store(36, local.get(1 + z));
  results.Store(40, inner.get(1) + tail);
}
