// SPDX-License-Identifier: MIT
// FEATURE: core ConstantBuffer
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 2
// EXPECT u32 12 8
// EXPECT u32 16 4
struct Constants {
  uint a;
  uint2 b;
  uint c[2];
};
ConstantBuffer<Constants> constants : register(b0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, constants.a);
  results.Store2(4, constants.b);
  results.Store(12, constants.c[1 + z]);
  Constants copy = constants;
  results.Store(16, copy.c[0]);
}
