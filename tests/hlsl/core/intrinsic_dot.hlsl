// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic dot
// EXPECT f32 0 32.0
// EXPECT i32 4 23
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(dot(float3(1, 2, 3) + z, float3(4, 5, 6))));
  results.Store(4, asuint(dot(int2(2, 3), int2(4, 5))));
}
