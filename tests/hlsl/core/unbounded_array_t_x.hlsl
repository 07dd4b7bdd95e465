// SPDX-License-Identifier: MIT
// FEATURE: core unbounded array T x[]
// EXPECT u32 0 3
ByteAddressBuffer buffers[] : register(t0, space1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, buffers[NonUniformResourceIndex(z + 2)].Load(12));
}
