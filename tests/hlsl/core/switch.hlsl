// SPDX-License-Identifier: MIT
// FEATURE: core switch
// EXPECT u32 0 10
// EXPECT u32 4 21
// EXPECT u32 8 1
// EXPECT u32 12 99
// EXPECT u32 16 10
uint f(uint x) {
  uint r = 0;
  switch (x) {
    case 0:
    case 1:
      r = 10;
      break;
    case 2: {
      r = 20;
    }
    case 3:
      r += 1;
      break;
    default:
      return 99;
  }
  return r;
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store4(0, uint4(f(z), f(2), f(3), f(7)));
  results.Store(16, f(1));
}
