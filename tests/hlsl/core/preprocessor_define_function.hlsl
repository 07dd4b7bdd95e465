// SPDX-License-Identifier: MIT
// FEATURE: core #define function-like
// EXPECT u32 0 13
#define MADD(a, b, c) ((a) * (b) + (c))
#define TWICE(x) MADD(x, 2, 0)
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, TWICE(3 + 1) + MADD(1, 2, 3));
}
