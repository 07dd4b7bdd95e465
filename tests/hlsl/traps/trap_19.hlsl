// SPDX-License-Identifier: MIT
// TRAP: 19 constant buffer fields of every size
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 2
// EXPECT u32 12 1
// EXPECT u32 16 7
cbuffer Record : register(b0) {
  uint index;
  uint2 pair;
  bool flag;
  uint4 tail;
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, uint4(index, pair, flag));
  results.Store(16, tail.w);
}
