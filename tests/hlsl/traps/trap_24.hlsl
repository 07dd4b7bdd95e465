// SPDX-License-Identifier: MIT
// TRAP: 24 deep call chains without recursion
// EXPECT u32 0 21
uint f0(uint x) { return x + 1; }
uint f1(uint x) { return f0(x) * 2; }
uint f2(uint x) { return f1(x) + f0(x); }
uint f3(uint x) { return f2(f2(x)); }
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, f3(z + 1));
}
