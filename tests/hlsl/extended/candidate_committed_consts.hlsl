// SPDX-License-Identifier: MIT
// FEATURE: extended CANDIDATE_/COMMITTED_ consts
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 1
// EXPECT u32 12 2
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, uint4(CANDIDATE_NON_OPAQUE_TRIANGLE, CANDIDATE_PROCEDURAL_PRIMITIVE, COMMITTED_TRIANGLE_HIT, COMMITTED_PROCEDURAL_PRIMITIVE_HIT));
}
