// SPDX-License-Identifier: MIT
// FEATURE: core bounded resource array T x[N]
// EXPECT u32 0 3
// EXPECT u32 4 4
ByteAddressBuffer buffers[4] : register(t0, space1);
ByteAddressBuffer grid[2][3] : register(t0, space2);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, buffers[z + 3].Load(12));
  results.Store(4, grid[1][z + 2].Load(16));
}
