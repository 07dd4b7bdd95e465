// SPDX-License-Identifier: MIT
// FEATURE: core .Load2
// EXPECT u32 0 3
// EXPECT u32 4 4
ByteAddressBuffer bytes : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store2(0, bytes.Load2(12));
}
