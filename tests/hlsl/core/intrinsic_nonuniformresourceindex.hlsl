// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic NonUniformResourceIndex
// EXPECT u32 0 3
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(NonUniformResourceIndex(z + 3)));
}
