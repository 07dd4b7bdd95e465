// SPDX-License-Identifier: MIT
// FEATURE: core do-while
// EXPECT u32 0 3
// EXPECT u32 4 3
// EXPECT u32 8 33
// EXPECT u32 12 1
RWByteAddressBuffer results : register(u0);

// Conditions with side effects, reached by `continue` as well.
[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint n = 0, k = z;
  do {
    ++n;
    if (n > z) continue;
    n += 10;
  } while (k++ < 2);
  results.Store2(0, uint2(n, k));
  k = z;
  uint m = 0;
  while (k++ < 3) {
    if (k == 2) continue;
    m += k * 10;
  }
  do {
    switch (k--) {
      case 4:
        m -= 7;
        continue;
      default:
        break;
    }
    if (k == 1) break;
  } while (k-- > z);
  results.Store2(8, uint2(m, k));
}
