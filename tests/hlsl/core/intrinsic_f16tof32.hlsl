// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic f16tof32
// EXPECT f32 0 1.0
// EXPECT f32 4 0.5
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(f16tof32(0x3c00 + z)));
  results.Store(4, asuint(f16tof32(uint2(0x4000, 0x3800)).y));
}
