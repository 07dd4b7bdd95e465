// SPDX-License-Identifier: MIT
// FEATURE: core #ifdef/#ifndef
// EXPECT u32 0 1
#define ON
#ifdef ON
#define A 1
#else
#define A 2
#endif
#ifndef ON
#error wrong
#endif
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, A);
}
