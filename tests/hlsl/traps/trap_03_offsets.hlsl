// SPDX-License-Identifier: MIT
// TRAP: 3 constant buffer packing
// EXPECT u32 0 4
// EXPECT u32 4 5
// EXPECT u32 8 4
// EXPECT u32 12 9
// EXPECT u32 16 58
// EXPECT u32 20 60
// EXPECT u32 24 116
// EXPECT u32 28 117
// EXPECT u32 32 0
// EXPECT u32 36 4
// EXPECT u32 40 8
// EXPECT u32 44 9
// EXPECT u32 48 5
// EXPECT u32 52 6
// EXPECT u32 56 3
// EXPECT u32 60 9
// EXPECT u32 64 10
// Offsets given by DXC's own layout tests, as word numbers.
cbuffer Tail : register(b0) {
  uint t_a;
  uint t_b[1];
  uint t_c;
};
cbuffer Matrices : register(b1) {
  uint m_dummy;
  uint3x2 m_foo[7];
  uint1x3 m_bar[5];
  uint m_end;
};
cbuffer Narrow : register(b2) {
  uint n_dummy;
  uint1x2 n_foo;
  uint n_end;
};
struct Inner {
  uint3 a;
  uint b;
  uint c;
};
cbuffer Nested : register(b3) {
  Inner s_inner;
  uint2 s_tail;  // in the row where the struct ends
};
cbuffer Rows : register(b4) {
  row_major uint3x2 r_matrix;
  uint r_end;
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store2(0, uint2(t_b[z], t_c));
  results.Store3(8, uint3(m_foo[0][0][0], m_foo[0][1][1], m_foo[6][2][1]));
  results.Store3(20, uint3(m_bar[z][0][0], m_bar[4][0][2], m_end));
  results.Store4(32, uint4(n_dummy, n_foo[0][0], n_foo[0][z + 1], n_end));
  results.Store3(48, uint3(s_tail, s_inner.b));
  results.Store2(60, uint2(r_matrix[2][1], r_end));
}
