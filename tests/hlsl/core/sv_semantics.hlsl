// SPDX-License-Identifier: MIT
// FEATURE: core SV_ semantics
// EXPECT u32 0 3
// EXPECT u32 4 2
// EXPECT u32 8 4
// EXPECT u32 12 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 2, 1)]
void main(uint3 id : SV_DispatchThreadID, uint index : SV_GroupIndex) {
  if (index == 7) {
    results.Store4(0, uint4(id.x, index - 5, id.x + 1, id.y));
  }
}
