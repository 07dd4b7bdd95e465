// SPDX-License-Identifier: MIT
// FEATURE: core #if expr/defined
// EXPECT u32 0 3
#define V 6
#if defined(V) && (V > 5) && !defined(W)
#define A 3
#elif 1
#define A 4
#endif
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, A);
}
