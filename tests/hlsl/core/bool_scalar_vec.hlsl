// SPDX-License-Identifier: MIT
// FEATURE: core bool scalar/vec
// EXPECT u32 0 1
// EXPECT u32 4 0
// EXPECT u32 8 1
// EXPECT u32 12 2
// EXPECT f32 16 1.0
// EXPECT u32 20 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  bool a = z == 0;
  bool3 b = bool3(a, !a, true);
  results.Store3(0, (uint3)b);
  results.Store(12, a + a);
  results.Store(16, asuint((float)b.x));
  bool c = 0.5;
  results.Store(20, c);
}
