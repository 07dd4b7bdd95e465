// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic asfloat
// EXPECT f32 0 1.0
// EXPECT f32 4 2.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(asfloat(0x3f800000 + z)));
  results.Store(4, asuint(asfloat(uint2(0, 0x40000000)).y));
}
