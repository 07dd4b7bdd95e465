// SPDX-License-Identifier: MIT
// FEATURE: core multi-dim array a[i][j] decl
// EXPECT u32 0 21
// EXPECT u32 4 6
static const uint kGrid[2][3] = {{1, 2, 3}, {4, 5, 6}};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint a[3][2];
  for (uint i = 0; i < 3; ++i)
    for (uint j = 0; j < 2; ++j) a[i][j] = i * 10 + j + z;
  results.Store2(0, uint2(a[2][1], kGrid[1][z + 2]));
}
