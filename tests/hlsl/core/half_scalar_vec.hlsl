// SPDX-License-Identifier: MIT
// FEATURE: core half scalar/vec
// EXPECT f32 0 3.0
// EXPECT f32 4 4.0
// EXPECT f32 8 6.0
// EXPECT f32 12 0.25
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  half a = 1.5 + z;
  half3 b = half3(a, 2, 3) * 2.0h;
  results.Store3(0, asuint((float3)b));
  min16float c = 0.25;
  results.Store(12, asuint((float)c));
}
