// SPDX-License-Identifier: MIT
// FEATURE: core enum
// EXPECT u32 0 0
// EXPECT u32 4 6
// EXPECT u32 8 50
// EXPECT u32 12 9
// EXPECT u32 16 60
enum Kind { kFirst, kSecond = 5, kThird, kMask = 1 << 3 };
uint describe(Kind kind) {
  switch (kind) {
    case kSecond:
      return 50;
    case kThird:
      return 60;
    default:
      return 0;
  }
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Kind kind = kThird;
  results.Store4(0, uint4(kFirst, kind, describe(kSecond), kMask | 1));
  results.Store(16, describe((Kind)(z + 6)));
}
