// SPDX-License-Identifier: MIT
// FEATURE: core inline
// EXPECT u32 0 10
inline uint f(uint x) {
  return x + 1;
}
static inline uint g(uint x) { return f(x) * 2; }
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, g(z + 4));
}
