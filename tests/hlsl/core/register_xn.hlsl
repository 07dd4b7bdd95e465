// SPDX-License-Identifier: MIT
// FEATURE: core register(xN)
// EXPECT u32 0 7
StructuredBuffer<uint> a : register(t2);
StructuredBuffer<uint> b : register(t1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, a[3] + b[4]);
}
