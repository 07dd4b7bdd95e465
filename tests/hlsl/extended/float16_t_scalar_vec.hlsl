// SPDX-License-Identifier: MIT
// FEATURE: extended float16_t scalar/vec
// OPTIONS: -enable-16bit-types -T lib_6_6
// EXPECT f32 0 0.333251953125
// EXPECT f32 4 1.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float16_t a = (float16_t)(1.0 + z) / (float16_t)3;
  results.Store(0, asuint((float)a));
  float16_t2 b = float16_t2(2, 3) * a;
  results.Store(4, asuint((float)b.y));
}
