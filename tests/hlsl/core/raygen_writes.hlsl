// SPDX-License-Identifier: MIT
// FEATURE: core ray generation writes a buffer
// EXPECT u32 0 1
// EXPECT u32 4 1
// EXPECT f32 8 2.5
// EXPECT i32 12 -1
// EXPECT u32 16 24
RWByteAddressBuffer results : register(u0);

uint factorial(uint n) {
  uint product = 1;
  for (uint i = 2; i <= n; ++i) {
    product *= i;
  }
  return product;
}

[shader("raygeneration")]
void Main() {
  const uint3 size = DispatchRaysDimensions();
  results.Store2(0, size.xy);
  results.Store(8, asuint(lerp(2.0, 3.0, 0.5)));
  results.Store(12, asuint(sign(-3.0f)));
  results.Store(16, factorial(4));
}
