// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic atan2
// EXPECT f32 0 2.356194490192345 8
// EXPECT f32 4 -1.5707963267948966 8
// EXPECT f32 8 3.141592653589793 3.141592653589793
// EXPECT f32 16 1.5707963267948966 1.5707963267948966 -1.5707963267948966
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(atan2(1.0 + z, -1.0)));
  results.Store(4, asuint(atan2(-1.0, 0.0 + z)));
  // Zeros, of both signs. [DXC: its expansion compares y >= 0 and x == 0]
  const float zero = z, minus = asfloat(0x80000000u + z);
  results.Store2(8, asuint(float2(atan2(zero, -1.0), atan2(minus, -1.0))));
  results.Store3(16, asuint(float3(atan2(zero, zero), atan2(minus, minus), atan2(-1.0, minus))));
}
