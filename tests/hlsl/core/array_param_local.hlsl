// SPDX-License-Identifier: MIT
// FEATURE: core array param/local
// EXPECT f32 0 18.0
// EXPECT f32 4 1.0
// EXPECT u32 8 7
float sum(float values[4]) {
  float total = 0;
  for (int i = 0; i < 4; ++i) {
    total += values[i];
  }
  values[0] = 100;
  return total;
}
void fill(out uint values[3], uint start) {
  for (uint i = 0; i < 3; i++) values[i] = start + i;
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float a[4] = {1, 2, 3, 4};
  a[z + 1] = 10;
  results.Store(0, asuint(sum(a)));
  results.Store(4, asuint(a[0]));
  uint b[3];
  fill(b, 5);
  results.Store(8, b[2]);
}
