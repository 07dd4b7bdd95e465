// SPDX-License-Identifier: MIT
// FEATURE: compute quads of 3-D groups
// OPTIONS: -T lib_6_7
// DISPATCH: 1 2 1
// Each of two groups of 6 x 2 x 2 threads has six quads, and each quad writes once: where its upper
// left thread is in the dispatch, the sum of the four threads' places in the group, and whether any
// and all of them are in column 4 or further right.
// EXPECT u32 0 0 0 0 14 0 0
// EXPECT u32 24 2 0 0 22 0 0
// EXPECT u32 48 4 0 0 30 1 1
// EXPECT u32 72 0 0 1 62 0 0
// EXPECT u32 96 2 0 1 70 0 0
// EXPECT u32 120 4 0 1 78 1 1
// EXPECT u32 144 0 2 0 14 0 0
// EXPECT u32 168 2 2 0 22 0 0
// EXPECT u32 192 4 2 0 30 1 1
// EXPECT u32 216 0 2 1 62 0 0
// EXPECT u32 240 2 2 1 70 0 0
// EXPECT u32 264 4 2 1 78 1 1
RWByteAddressBuffer results : register(u0);

struct Ids {
  uint3 place : SV_DispatchThreadID;
  int3 thread : SV_GroupThreadID;
  uint index : SV_GroupIndex;
  uint2 group : SV_GroupID;
};
uint sum(uint v) {
  const uint row = v + QuadReadAcrossX(v);
  return row + QuadReadAcrossY(row);
}

[shader("compute")]
[numthreads(6, 2, 2)]
void main(Ids ids) {
  const uint z = results.Load(65532);
  const uint total = sum(ids.index + z);
  const bool is_right = ids.thread.x + z >= 4;
  const bool any = QuadAny(is_right), all = QuadAll(is_right);
  if (ids.thread.x % 2 == 1 || ids.thread.y == 1) return;
  const uint at = 24 * (6 * ids.group.y + 3 * ids.thread.z + ids.thread.x / 2);
  results.Store3(at, ids.place);
  results.Store3(at + 12, uint3(total, any, all));
}
