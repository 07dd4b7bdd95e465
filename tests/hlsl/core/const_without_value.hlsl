// SPDX-License-Identifier: MIT
// FEATURE: core constants without a value
// EXPECT u32 0 0
// EXPECT u32 4 0
// EXPECT u32 8 0
// EXPECT u32 12 7
struct Pair {
  uint a;
  uint b;
};
static const uint kNothing;
static const Pair kPair;
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const uint local;
  const float3 vector_of;
  results.Store4(0, uint4(kNothing + z, kPair.b + z, local + z, 7 + (uint)vector_of.y));
}
