// SPDX-License-Identifier: MIT
// FEATURE: core uint32_t scalar/vec
// EXPECT u32 0 3
// EXPECT u32 4 4
// EXPECT u32 8 4294967295
// EXPECT f32 12 0.5
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint32_t a = 3 + z;
  uint32_t2 b = uint32_t2(a, 4);
  int32_t c = -1;
  float32_t d = 0.5;
  results.Store2(0, b);
  results.Store(8, asuint(c));
  results.Store(12, asuint(d));
}
