// SPDX-License-Identifier: MIT
// FEATURE: core bare global uniform with register(cN)
// EXPECT u32 0 12 13
// EXPECT u32 8 4 8 9 14
// EXPECT u32 24 5 16
RWByteAddressBuffer results : register(u0);

// Those without a register come behind the last one with one, in their order.
uint2 behind;                  // c3.x
uint4 second : register(c1);
uint3 third : register(c2);
uint after;                    // c3.z
uint alias : register(c1);     // the first component of `second`
uint4 row;                     // c4

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store2(0, behind);
  results.Store4(8, uint4(alias, third.xy, after));
  results.Store2(24, uint2(second.y, row.x));
}
