// SPDX-License-Identifier: MIT
// FEATURE: core #pragma other
// EXPECT u32 0 1
#pragma warning(disable : 3571)
#pragma unknown thing
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, 1);
}
