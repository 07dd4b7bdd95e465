// SPDX-License-Identifier: MIT
// FEATURE: core static (non-const) global
// EXPECT u32 0 5
// EXPECT u32 4 6
// EXPECT u32 8 7
// EXPECT f32 12 0.0
// EXPECT f32 16 2.0
static uint counter = 5;
static float3 direction;
uint next() {
  return counter++;
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store3(0, uint3(next() + z, next(), counter));
  results.Store(12, asuint(direction.x));
  direction = 2;
  results.Store(16, asuint(direction.y));
}
