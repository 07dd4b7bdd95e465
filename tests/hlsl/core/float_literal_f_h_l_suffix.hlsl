// SPDX-License-Identifier: MIT
// FEATURE: core float literal f/h/l suffix
// EXPECT f32 0 4.0
// EXPECT u32 4 1
// EXPECT f32 8 1002.5
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float a = 1.5f + 2.5h + z;
  double b = 0.1l;
  results.Store(0, asuint(a));
  results.Store(4, b == 0.1l ? 1u : 0u);
  results.Store(8, asuint(1e3f + .5 + 2.));
}
