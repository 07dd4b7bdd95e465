// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic NonUniformResourceIndex
// EXPECT u32 0 3
// EXPECT u32 4 10
// EXPECT u32 8 11
// EXPECT u32 12 12
// EXPECT u32 16 13
RWByteAddressBuffer results : register(u0);
RWByteAddressBuffer buffers[4] : register(u0, space1);
ByteAddressBuffer read_only[] : register(t0, space2);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint index = NonUniformResourceIndex(i);
  buffers[index].Store(0, 10 + i);
  GroupMemoryBarrierWithGroupSync();
  results.Store(4 + 4 * i, buffers[NonUniformResourceIndex(i)].Load(0));
  if (i == 3) results.Store(0, read_only[NonUniformResourceIndex(i + 1)].Load(4 * index));
}
