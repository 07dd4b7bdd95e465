// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic lerp
// EXPECT f32 0 1.5
// EXPECT f32 4 2.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(lerp(1.0, 3.0, 0.25 + z)));
  results.Store(4, asuint(lerp(float3(0, 0, 0), float3(2, 4, 6), 0.5).y));
}
