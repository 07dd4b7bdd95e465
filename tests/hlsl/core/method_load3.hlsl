// SPDX-License-Identifier: MIT
// FEATURE: core .Load3
// EXPECT u32 0 3
// EXPECT u32 4 4
// EXPECT u32 8 5
ByteAddressBuffer bytes : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store3(0, bytes.Load3(12));
}
