// SPDX-License-Identifier: MIT
// FEATURE: core ## paste
// EXPECT u32 0 5
#define NAME(a, b) a##b
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  uint NAME(va, lue) = 5;
  results.Store(0, value);
}
