// SPDX-License-Identifier: MIT
// FEATURE: extended int16_t scalar/vec
// OPTIONS: -enable-16bit-types -T lib_6_6
// EXPECT i32 0 -32768
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  int16_t a = (int16_t)(32767 + (int)z);
  a = a + (int16_t)1;
  results.Store(0, asuint((int)a));
}
