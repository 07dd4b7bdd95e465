// SPDX-License-Identifier: MIT
// FEATURE: compute groupshared
// DISPATCH: 3 1 1
// EXPECT u32 0 4
// EXPECT u32 4 4
// EXPECT u32 8 4
// EXPECT u32 12 6
// EXPECT u32 16 10
// EXPECT u32 20 14
// EXPECT u32 24 12
// Each group has its own memory and its own count.
RWByteAddressBuffer results : register(u0);
struct Cell {
  uint2 value;
  float weight;
};
groupshared Cell cells[4];
groupshared uint count;

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint index : SV_GroupIndex, uint3 group : SV_GroupID, uint3 id : SV_DispatchThreadID) {
  if (index == 0) count = 0;
  cells[index].value = uint2(0, index + group.x);
  cells[index].weight = 1;
  GroupMemoryBarrierWithGroupSync();
  InterlockedAdd(count, 1);
  results.InterlockedAdd(24, 1u);
  GroupMemoryBarrierWithGroupSync();
  if (index == 3) {
    uint sum = 0;
    for (uint i = 0; i < 4; ++i) sum += cells[i].value.y;
    results.Store(4 * group.x, count);
    results.Store(12 + 4 * group.x, sum);
  }
}
