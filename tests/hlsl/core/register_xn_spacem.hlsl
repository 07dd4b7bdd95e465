// SPDX-License-Identifier: MIT
// FEATURE: core register(xN, spaceM)
// EXPECT u32 0 6
StructuredBuffer<uint> a : register(t0, space3);
RWStructuredBuffer<uint> b : register(u0, space1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  b[2] = a[5] + 1;
  results.Store(0, b[2]);
}
