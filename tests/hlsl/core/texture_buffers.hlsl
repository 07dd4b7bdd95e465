// SPDX-License-Identifier: MIT
// FEATURE: core TextureBuffer and tbuffer
// Their members lie in rows, as in a constant buffer.
// EXPECT u32 0 0 1 2 3
// EXPECT u32 16 8 20 27 24
// A tbuffer, with packoffset.
// EXPECT u32 32 1 3 22 20
// Elements of arrays of them; parameters and local variables.
// EXPECT u32 48 12 2 3 1
// Beyond the buffer there are zeros.
// EXPECT u32 64 0 0
// Each thread reads at an offset of its own.
// EXPECT u32 80 4 8 12 4 8 12 4 8
struct Part {
  uint a;
  uint3 b;
};
struct Table {
  uint head;
  uint2 pair;
  uint list[3];
  row_major uint2x2 matrix2;
  Part part;
  uint sum() { return head + pair.x + pair.y; }
};
TextureBuffer<Table> table : register(t0);
TextureBuffer<Table> tables[3] : register(t1);
TextureBuffer<Part> parts[] : register(t0, space3);
tbuffer Block : register(t7, space1) {
  uint one : packoffset(c0.y);
  uint3 three : packoffset(c0.y);
  uint far : packoffset(c5.z);
  uint list[2] : packoffset(c4);
};
RWByteAddressBuffer results : register(u0);

uint last(TextureBuffer<Part> part) { return part.b.z; }

[shader("compute")]
[numthreads(8, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(80 + i * 4, table.list[i % 3]);
  if (i != 0) return;
  results.Store4(0, uint4(table.head, table.pair, table.sum()));
  const Table copy = table;
  results.Store4(16, uint4(table.list[1 + z], table.matrix2[1 + z][0], table.part.b.z, copy.part.a));
  results.Store4(32, uint4(one, three.z, far, list[1 + z]));
  TextureBuffer<Part> same = parts[1];
  results.Store4(48, uint4(tables[1 + z].list[2], parts[NonUniformResourceIndex(z + 2)].b.y, last(same), same.b.x));
  results.Store2(64, uint2(table.list[100000 + z], list[70 + z]));
}
