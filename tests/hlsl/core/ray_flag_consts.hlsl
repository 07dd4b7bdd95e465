// SPDX-License-Identifier: MIT
// FEATURE: core RAY_FLAG_* consts
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 2
// EXPECT u32 12 4
// EXPECT u32 16 8
// EXPECT u32 20 16
// EXPECT u32 24 32
// EXPECT u32 28 64
// EXPECT u32 32 128
// EXPECT u32 36 256
// EXPECT u32 40 512
RWByteAddressBuffer results : register(u0);
static const uint kFlags[] = {RAY_FLAG_NONE,
                              RAY_FLAG_FORCE_OPAQUE,
                              RAY_FLAG_FORCE_NON_OPAQUE,
                              RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH,
                              RAY_FLAG_SKIP_CLOSEST_HIT_SHADER,
                              RAY_FLAG_CULL_BACK_FACING_TRIANGLES,
                              RAY_FLAG_CULL_FRONT_FACING_TRIANGLES,
                              RAY_FLAG_CULL_OPAQUE,
                              RAY_FLAG_CULL_NON_OPAQUE,
                              RAY_FLAG_SKIP_TRIANGLES,
                              RAY_FLAG_SKIP_PROCEDURAL_PRIMITIVES};

[shader("compute")]
[numthreads(11, 1, 1)]
void main(uint i : SV_GroupIndex) {
  results.Store(4 * i, kFlags[i]);
}
