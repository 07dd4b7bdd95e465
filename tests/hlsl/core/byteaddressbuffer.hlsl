// SPDX-License-Identifier: MIT
// FEATURE: core ByteAddressBuffer
// EXPECT u32 0 5
// EXPECT u32 4 2
// EXPECT u32 8 3
// EXPECT u32 12 4
// EXPECT u32 16 5
ByteAddressBuffer bytes : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, bytes.Load(20));
  results.Store4(4, bytes.Load4(8));
}
