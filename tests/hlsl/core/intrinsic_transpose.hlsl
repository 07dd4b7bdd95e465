// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic transpose
// EXPECT f32 0 3.0
// EXPECT f32 4 4.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(transpose(float2x3(1, 2, 3, 4, 5, 6))[2][0] + z));
  results.Store(4, asuint(transpose(float2x3(1, 2, 3, 4, 5, 6))[0][1]));
}
