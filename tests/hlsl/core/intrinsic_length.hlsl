// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic length
// EXPECT f32 0 7.0 1
// EXPECT f32 4 4.0 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(length(float3(2, 3, 6) + z)));
  results.Store(4, asuint(length(-4.0 + z)));
}
