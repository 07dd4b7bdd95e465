// SPDX-License-Identifier: MIT
// FEATURE: core #undef
// EXPECT u32 0 2
#define A 1
#undef A
#define A 2
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, A);
}
