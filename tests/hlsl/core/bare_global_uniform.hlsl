// SPDX-License-Identifier: MIT
// FEATURE: core bare global uniform ($Globals)
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 2
// EXPECT u32 12 3
// EXPECT u32 16 4
uint a;
uint3 b;
uint c;
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, a);
  results.Store3(4, b);
  results.Store(16, c);
}
