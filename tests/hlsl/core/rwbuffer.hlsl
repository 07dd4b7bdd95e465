// SPDX-License-Identifier: MIT
// FEATURE: core RWBuffer
// EXPECT u32 0 8
// EXPECT u32 4 6
// EXPECT u32 8 5
RWBuffer<uint> values : register(u1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  values[3] = 8;
  values[4] += 2;
  results.Store3(0, uint3(values[3], values[4], values.Load(5)));
}
