// SPDX-License-Identifier: MIT
// FEATURE: core implicit trunc: uint2/float2 = DispatchRays*() w/o swizzle
// EXPECT u32 0 0
// EXPECT u32 4 0
// EXPECT f32 8 1.0
// EXPECT f32 12 1.0
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  uint2 index = DispatchRaysIndex();
  float2 size = DispatchRaysDimensions();
  results.Store2(0, index);
  results.Store2(8, asuint(size));
}
