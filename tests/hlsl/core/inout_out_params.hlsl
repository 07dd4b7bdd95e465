// SPDX-License-Identifier: MIT
// FEATURE: core inout/out params
// EXPECT u32 0 2
// EXPECT f32 4 7.25
void split(float x, out int whole, inout float sum) {
  whole = (int)x;
  sum += x;
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  int whole;
  float sum = 1 + z;
  split(3.75, whole, sum);
  split(2.5, whole, sum);
  results.Store(0, asuint(whole));
  results.Store(4, asuint(sum));
}
