// SPDX-License-Identifier: MIT
// FEATURE: compute InterlockedExchange of groupshared floats and texels
// Each of 8 threads puts its number, after -1: what they found and what stays are -1 to 7, 27; with 1 added to each
// of the 8 that were found, 35.
// EXPECT u32 0 35
// One thread finds the 0; what it put stays.
// EXPECT u32 4 1 1
// -0 is not 0, bit by bit.
// EXPECT u32 12 0x80000000 0x80000000
// An element beyond the array is not there.
// EXPECT f32 20 0
// A typed buffer, and a comparison in it; out of bounds.
// EXPECT f32 24 2.5 3.5 3.5 4.5 0
// A texel, in which (3, 4) holds 43, and one that is not there.
// EXPECT f32 44 43 0.5 0
RWByteAddressBuffer results : register(u0);
RWBuffer<float> typed_single : register(u1);
RWTexture2D<float> image_single : register(u2);

groupshared float number;
groupshared float numbers[2];
groupshared uint total, found;

[shader("compute")]
[numthreads(8, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);  // 0, known at run time only
  float before;
  if (i == 0) {
    number = -1 - int(z);
    numbers[0] = -0.0f * (z + 1);
    numbers[1] = 0;
    total = found = 0;
  }
  GroupMemoryBarrierWithGroupSync();
  InterlockedExchange(number, float(i), before);
  InterlockedAdd(total, uint(before + 1));
  InterlockedCompareExchangeFloatBitwise(numbers[1 + z], 0.0f, float(i + 1), before);
  if (before == 0) InterlockedAdd(found, 1);
  GroupMemoryBarrierWithGroupSync();
  if (i != 0) return;
  results.Store3(0, uint3(total + uint(number), found, numbers[1] >= 1 && numbers[1] <= 8 ? 1 : 0));
  InterlockedCompareStoreFloatBitwise(numbers[z], 0.0f, 5.0f);
  results.Store(12, asuint(numbers[0]));
  InterlockedCompareExchangeFloatBitwise(numbers[z], 0.0f, 6.0f, before);
  results.Store(16, asuint(before));
  InterlockedExchange(numbers[7 + z], 9.0f, before);
  results.Store(20, asuint(before));

  typed_single[3] = 2.5 + z;
  InterlockedExchange(typed_single[3], 3.5, before);
  results.Store2(24, asuint(float2(before, typed_single[3])));
  InterlockedCompareExchangeFloatBitwise(typed_single[3], 3.5f, 4.5f, before);
  results.Store2(32, asuint(float2(before, typed_single[3])));
  InterlockedExchange(typed_single[100000 + z], 1, before);
  results.Store(40, asuint(before));

  InterlockedExchange(image_single[uint2(3, 4 + z)], 0.5, before);
  results.Store2(44, asuint(float2(before, image_single[uint2(3, 4)])));
  InterlockedExchange(image_single[uint2(99, z)], 0.5, before);
  results.Store(52, asuint(before));
}
