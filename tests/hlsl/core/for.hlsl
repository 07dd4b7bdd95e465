// SPDX-License-Identifier: MIT
// FEATURE: core for
// EXPECT u32 0 18
// EXPECT u32 4 0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint sum = z;
  for (uint i = 0; i < 10; ++i) {
    if (i == 3) continue;
    if (i == 7) break;
    sum += i;
  }
  int j;
  for (j = 5; j > 0; j--)
    ;
  for (;;) break;
  results.Store2(0, uint2(sum, j));
}
