// SPDX-License-Identifier: MIT
// FEATURE: core .Load4
// EXPECT u32 0 3
// EXPECT u32 4 4
// EXPECT u32 8 5
// EXPECT u32 12 6
ByteAddressBuffer bytes : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, bytes.Load4(12));
}
