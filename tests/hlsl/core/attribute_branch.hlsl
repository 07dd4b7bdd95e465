// SPDX-License-Identifier: MIT
// FEATURE: core attribute [branch]
// EXPECT u32 0 6
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint a = 1;
  [branch]
  if (z == 0) a = 2;
  [flatten] if (z == 1) { a = 3; } else { a += 4; }
  results.Store(0, a);
}
