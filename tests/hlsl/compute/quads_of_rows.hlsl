// SPDX-License-Identifier: MIT
// FEATURE: compute quads of groups with an odd height
// Four threads in a row of SV_GroupIndex are a quad: (0 to 3, 0), (0 to 3, 1), (0 to 3, 2).
// EXPECT u32 0 1 0 3 2 5 4 7 6 9 8 11 10
// EXPECT u32 48 2 3 0 1 6 7 4 5 10 11 8 9
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 3, 1)]
void main(uint i : SV_GroupIndex) {
  const uint v = i + results.Load(65532);
  results.Store(4 * i, QuadReadAcrossX(v));
  results.Store(48 + 4 * i, QuadReadAcrossY(v));
}
