// SPDX-License-Identifier: MIT
// A large constant may stay where it was read from, but only if nothing can write to that place and
// its layout there is that of a local.
// FEATURE: core StructuredBuffer
// EXPECT u32 0 32
// EXPECT u32 4 35
// EXPECT u32 8 42
// EXPECT u32 12 45
// EXPECT u32 16 0
// EXPECT u32 20 0
// EXPECT u32 24 0
// EXPECT u32 28 33
// EXPECT u32 32 32
// EXPECT u32 36 0
// EXPECT u32 40 1
// EXPECT u32 44 31
// EXPECT u32 48 7
// EXPECT u32 52 13
// EXPECT u32 56 8
// EXPECT u32 60 19
// EXPECT u32 64 16
// EXPECT u32 68 99
// EXPECT u32 72 240
// EXPECT u32 76 0
struct Large {
  uint first;
  uint3 place;
  uint4 colors[2];
  int codes[4];
};
struct Mixed {
  bool on;
  uint rest[15];
};
struct Packed {
  uint4 a;
  uint3 b;
  uint c;
  uint4 d[2];
};
struct Spread {
  uint a[3];  // each in a row of its own
  uint4 e[2];
};
StructuredBuffer<Large> items[2] : register(t0);  // in a table, so accesses are bounds-checked
StructuredBuffer<Mixed> mixed : register(t2);
ConstantBuffer<Packed> packed : register(b0);
ConstantBuffer<Spread> spread : register(b1);
RWByteAddressBuffer results : register(u0);
RWStructuredBuffer<Large> values : register(u1);

uint Change(Large item) {
  item.first += 1;
  return item.first;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const Large inside = items[z][2 + z];
  results.Store(0, inside.first);
  results.Store(4, inside.place.z);
  results.Store(8, inside.colors[1 + z].z);
  results.Store(12, inside.codes[1 + z]);
  results.Store(16, inside.codes[9 + z]);
  const Large outside = items[z][16 + z];
  results.Store(20, outside.first);
  results.Store(24, outside.codes[3 - z]);
  results.Store(28, Change(inside));
  results.Store(32, inside.first);
  const Mixed off = mixed[z];
  results.Store(36, off.on ? 1 : 0);
  const Mixed on = mixed[1 + z];
  results.Store(40, on.on ? 1 : 0);
  results.Store(44, on.rest[14 - z]);
  const Packed constants = packed;
  results.Store(48, constants.c + z);
  results.Store(52, constants.d[1 - z].y);
  const Spread rows = spread;
  results.Store(56, rows.a[2 - z]);
  results.Store(60, rows.e[1 - z].w);
  const Large before = values[1 + z];
  values[1].first = 99;
  results.Store(64, before.first);
  results.Store(68, values[1].first);
  const Large last = items[z][15 + z];
  results.Store(72, last.first);
  const Large far = items[z][0xFFFFFFFF - z];
  results.Store(76, far.codes[0]);
}
