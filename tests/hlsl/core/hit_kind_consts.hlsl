// SPDX-License-Identifier: MIT
// FEATURE: core HIT_KIND_* consts
// EXPECT u32 0 254
// EXPECT u32 4 255
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store2(0, uint2(HIT_KIND_TRIANGLE_FRONT_FACE, HIT_KIND_TRIANGLE_BACK_FACE));
}
