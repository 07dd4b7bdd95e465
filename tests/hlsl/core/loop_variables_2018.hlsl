// SPDX-License-Identifier: MIT
// FEATURE: core loop variables of HLSL 2018
// OPTIONS: -HV 2018
// EXPECT u32 0 4
// EXPECT u32 4 12
// EXPECT u32 8 6
// EXPECT u32 12 3
// EXPECT u32 16 9
uint sum(uint n) {
  uint result = 0;
  for (uint i = 0; i < n; ++i) result += i;
  return result * 10 + i;
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  for (uint i = z; i < 10; ++i) {
    if (i == 4) break;
  }
  results.Store(0, i);
  // The most recent declaration is the one that is meant.
  uint total = 0;
  for (int i = 0; i < 3; ++i) total += 2;
  results.Store3(4, uint3(total + i + 3, total, i));
  for (uint j = z, k = 1; j < 4; ++j) k *= 3;
  results.Store(16, k / 9);
  results.Store(0, results.Load(0) + sum(z + 3) - 33);
}
