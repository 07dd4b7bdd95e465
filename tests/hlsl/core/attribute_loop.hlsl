// SPDX-License-Identifier: MIT
// FEATURE: core attribute [loop]
// EXPECT u32 0 30
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint sum = z;
  [loop]
  for (uint i = 0; i < 5; ++i) sum += i * i;
  results.Store(0, sum);
}
