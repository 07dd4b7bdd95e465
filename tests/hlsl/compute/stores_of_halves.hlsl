// SPDX-License-Identifier: MIT
// FEATURE: compute stores to R16_FLOAT
// Rounded toward zero: 0.3, -0.3, 65520 and 1e6, the last two to the largest finite number.
// EXPECT u32 0 0x3e998000 0xbe998000 0x477fe000 0x477fe000
// EXPECT u32 16 0x3e998000 0xbe998000 0x477fe000 0x477fe000
RWByteAddressBuffer results : register(u0);
RWBuffer<float> typed_half : register(u1);
RWTexture2D<float> image_half : register(u2);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const float numbers[4] = {0.3, -0.3, 65520, 1e6};
  typed_half[i] = numbers[i];
  image_half[uint2(i, 1)] = numbers[i];
  DeviceMemoryBarrier();
  results.Store(i * 4, asuint(typed_half[i]));
  results.Store(16 + i * 4, asuint(image_half[uint2(i, 1)]));
}
