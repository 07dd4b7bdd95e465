// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic fmod
// EXPECT f32 0 -1.5
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(fmod(-7.5 + z, 2.0)));
}
