// SPDX-License-Identifier: MIT
// FEATURE: core RAY_FLAG_* consts
// EXPECT u32 0 529
// EXPECT u32 4 12
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  uint flags = RAY_FLAG_FORCE_OPAQUE | RAY_FLAG_CULL_BACK_FACING_TRIANGLES | RAY_FLAG_SKIP_PROCEDURAL_PRIMITIVES;
  results.Store(0, flags);
  results.Store(4, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER);
}
