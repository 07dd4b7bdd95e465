// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic reversebits
// EXPECT u32 0 2147483648
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(reversebits(1u + z)));
}
