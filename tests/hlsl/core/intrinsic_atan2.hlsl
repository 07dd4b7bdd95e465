// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic atan2
// EXPECT f32 0 2.356194490192345 8
// EXPECT f32 4 -1.5707963267948966 8
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(atan2(1.0 + z, -1.0)));
  results.Store(4, asuint(atan2(-1.0, 0.0 + z)));
}
