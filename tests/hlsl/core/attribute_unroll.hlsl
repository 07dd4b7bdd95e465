// SPDX-License-Identifier: MIT
// FEATURE: core attribute [unroll]
// EXPECT u32 0 9
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint sum = z;
  [unroll]
  for (uint i = 0; i < 4; ++i) sum += i;
  [unroll(3)]
  for (uint j = 0; j < 3; ++j) sum += j;
  results.Store(0, sum);
}
