// SPDX-License-Identifier: MIT
// FEATURE: core #define object-like
// EXPECT u32 0 14
#define COUNT 3
#define SUM (COUNT + 4)
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, SUM * 2);
}
