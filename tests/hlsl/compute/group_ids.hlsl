// SPDX-License-Identifier: MIT
// FEATURE: compute SV_GroupID, SV_GroupThreadID, SV_GroupIndex
// DISPATCH: 2 1 2
// EXPECT u32 0 0
// EXPECT u32 4 100
// EXPECT u32 8 1
// EXPECT u32 12 101
// EXPECT u32 16 200
// EXPECT u32 20 300
// EXPECT u32 24 201
// EXPECT u32 28 301
// EXPECT u32 32 1000
// EXPECT u32 36 1100
// EXPECT u32 40 1001
// EXPECT u32 44 1101
// EXPECT u32 48 1200
// EXPECT u32 52 1300
// EXPECT u32 56 1201
// EXPECT u32 60 1301
RWByteAddressBuffer results : register(u0);
struct Inputs {
  uint3 group : SV_GroupID;
  int3 thread : SV_GroupThreadID;
};

[shader("compute")]
[numthreads(2, 2, 1)]
void main(Inputs inputs, uint index : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  const uint3 from_parts = inputs.group * uint3(2, 2, 1) + inputs.thread;
  if (any(from_parts != id)) return;
  const uint slot = id.x + 4 * id.y + 8 * id.z;
  results.Store(slot * 4, inputs.group.x + 10 * inputs.group.y + 100 * index + 1000 * id.z);
}
