// SPDX-License-Identifier: MIT
// FEATURE: compute quads of 2-D groups before shader model 6.6
// OPTIONS: -T lib_6_5
// Which threads are a quad is the implementation's choice: here four in a row of SV_GroupIndex.
// EXPECT u32 0 1 0 3 2 5 4 7 6
// EXPECT u32 32 2 3 0 1 6 7 4 5
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 2, 1)]
void main(uint i : SV_GroupIndex) {
  const uint v = i + results.Load(65532);
  results.Store(4 * i, QuadReadAcrossX(v));
  results.Store(32 + 4 * i, QuadReadAcrossY(v));
}
