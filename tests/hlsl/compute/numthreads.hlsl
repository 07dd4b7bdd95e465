// SPDX-License-Identifier: MIT
// FEATURE: compute attribute [numthreads]
// EXPECT u32 0 28
// EXPECT u32 4 8
RWByteAddressBuffer results : register(u0);
static const uint kWidth = 4;

[shader("compute")]
[numthreads(kWidth, 2, 1)]
void main(uint index : SV_GroupIndex) {
  results.InterlockedAdd(0, index);
  results.InterlockedAdd(4, 1u);
}
