// SPDX-License-Identifier: MIT
// FEATURE: compute SV_GroupID, SV_GroupThreadID, SV_GroupIndex
// EXPECT u32 0 0
// EXPECT u32 4 0
// EXPECT u32 8 0
// EXPECT u32 12 1
// EXPECT u32 16 1
// EXPECT u32 20 3
RWByteAddressBuffer results : register(u0);
struct Inputs {
  uint3 group : SV_GroupID;
  int3 thread : SV_GroupThreadID;
};

[shader("compute")]
[numthreads(2, 2, 1)]
void main(Inputs inputs, uint index : SV_GroupIndex) {
  if (index == 3) {
    results.Store3(0, inputs.group);
    results.Store3(12, uint3(inputs.thread.xy, index));
  }
}
