// SPDX-License-Identifier: MIT
// FEATURE: core Buffer
// EXPECT u32 0 3
// EXPECT u32 4 9
Buffer<uint> values : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store2(0, uint2(values[3], values.Load(9)));
}
