// SPDX-License-Identifier: MIT
// FEATURE: core declarations in conditions
// EXPECT u32 0 5
// EXPECT u32 4 8
// EXPECT u32 8 6
// EXPECT u32 12 12
// EXPECT u32 16 30
uint next(inout uint x) { return x--; }
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint taken = 0;
  if (uint five = 5 + z) taken += five;
  if (uint none = z) {
    taken += 100;
  } else {
    taken += none;
  }
  results.Store(0, taken);
  // Both branches see the variable, and so does `else if`.
  uint chain = 0;
  if (uint a = z) {
    chain = 1;
  } else if (uint b = a + 8) {
    chain = a + b;
  }
  results.Store(4, chain);
  uint left = 3 + z, sum = 0;
  while (uint now = next(left)) sum += now;
  results.Store(8, sum);
  uint rounds = 0;
  left = 4 + z;
  for (uint i = 0; const uint now = next(left); ++i) {
    if (now == 3) continue;
    rounds += now + i;
  }
  results.Store(12, rounds);
  switch (const uint kind = 3 + z) {
    case 3:
      results.Store(16, kind * 10);
      break;
    default:
      results.Store(16, kind);
      break;
  }
}
