// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic refract
// EXPECT f32 0 -1.0 2
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(refract(float3(0, -1, 0) + z, float3(0, 1, 0), 0.5).y));
}
