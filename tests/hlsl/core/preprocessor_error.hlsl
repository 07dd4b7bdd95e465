// SPDX-License-Identifier: MIT
// FEATURE: core #error
// EXPECT u32 0 1
#if 0
#error not reached
#endif
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, 1);
}
