// SPDX-License-Identifier: MIT
// FEATURE: core local static const array
// EXPECT f32 0 5.0
// EXPECT f32 4 6.0
// EXPECT u32 8 3
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  static const float2 kOffsets[] = {float2(1, 2), float2(3, 4), {5, 6}};
  static const uint kCount = 3;
  results.Store2(0, asuint(kOffsets[z + 2]));
  results.Store(8, kCount);
}
