// SPDX-License-Identifier: MIT
// FEATURE: core #pragma pack_matrix and typedefs
// Rows are words 0 1 and 4 5 of a row-major matrix, 0 4 and 1 5 of a column-major one.
// EXPECT u32 0 0 1 4 5
// EXPECT u32 16 8 9 12 13
// EXPECT u32 32 16 20 17 21
// EXPECT u32 48 24 25 28 29
// EXPECT u32 64 32 36 33 37
// EXPECT u32 80 40 41 44 45
// EXPECT u32 96 0 1 4 5
// EXPECT u32 112 8 12 9 13
// EXPECT u32 128 16 17 20 21
RWByteAddressBuffer results : register(u0);

typedef uint2x2 Plain;
typedef Plain Again;
typedef column_major uint2x2 Columns;
typedef Plain List[1];
template <typename T> using Square = matrix<T, 2, 2>;

// The pragma above the use of a typedef counts, unless the typedef itself has an order.
#pragma pack_matrix(row_major)
typedef Plain Rows;
struct Holder {
  Plain value;
};
cbuffer Constants : register(b0) {
  Plain a;
  Again b;
  Columns c;
  Plain d[1];
  List e;  // not a matrix
  Square<uint> f;
};
#pragma pack_matrix(column_major)
cbuffer More : register(b1) {
  Rows g;
  Plain h;
  Holder i;
};

void store(uint at, uint2x2 m) { results.Store4(at, uint4(m[0], m[1])); }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  store(0, a);
  store(16, b);
  store(32, c);
  store(48, d[0]);
  store(64, e[0]);
  store(80, f);
  store(96, g);
  store(112, h);
  store(128, i.value);
}
