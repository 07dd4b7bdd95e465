// SPDX-License-Identifier: MIT
// FEATURE: core do-while
// EXPECT u32 0 4
// EXPECT u32 4 8
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint n = z, sum = 0;
  do {
    ++n;
    if (n == 2) continue;
    sum += n;
  } while (n < 4);
  results.Store2(0, uint2(n, sum));
}
