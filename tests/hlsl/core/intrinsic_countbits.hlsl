// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic countbits
// EXPECT u32 0 16
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(countbits(0xff00ffu + z)));
}
