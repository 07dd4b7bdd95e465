// SPDX-License-Identifier: MIT
// FEATURE: compute quads of 2-D groups
// In each line thread (x, y), at 4 * y + x: its right or left, lower or upper and diagonal neighbour
// in the quad; the quad's lane 1; the place of its lane in the quad.
// EXPECT u32 0 1 4 5 1 0
// EXPECT u32 20 0 5 4 1 1
// EXPECT u32 40 3 6 7 3 0
// EXPECT u32 60 2 7 6 3 1
// EXPECT u32 80 5 0 1 1 2
// EXPECT u32 100 4 1 0 1 3
// EXPECT u32 120 7 2 3 3 2
// EXPECT u32 140 6 3 2 3 3
// EXPECT u32 160 9 12 13 9 0
// EXPECT u32 180 8 13 12 9 1
// EXPECT u32 200 11 14 15 11 0
// EXPECT u32 220 10 15 14 11 1
// EXPECT u32 240 13 8 9 9 2
// EXPECT u32 260 12 9 8 9 3
// EXPECT u32 280 15 10 11 11 2
// EXPECT u32 300 14 11 10 11 3
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 4, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = i + z;
  results.Store4(20 * i, uint4(QuadReadAcrossX(v), QuadReadAcrossY(v), QuadReadAcrossDiagonal(v),
                               QuadReadLaneAt(v, 1)));
  results.Store(20 * i + 16, WaveGetLaneIndex() % 4);
}
