// SPDX-License-Identifier: MIT
// FEATURE: compute InterlockedExchange of floats, and FloatBitwise
// EXPECT f32 0 1.5 2.5
// -0 and 0 have other bits; a NaN has its own.
// EXPECT u32 8 0x80000000 0x80000000 0x7FC00000 0x3F800000
// EXPECT f32 24 0.5 4
// EXPECT f32 32 4 8
// EXPECT u32 40 3
RWByteAddressBuffer results : register(u0);
RWStructuredBuffer<float> numbers : register(u1);
struct Item {
  uint4 head;
  float3 weights;
};
RWStructuredBuffer<Item> items : register(u2);
RWByteAddressBuffer raw : register(u3);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float before;
  numbers[0] = 1.5 + z;
  InterlockedExchange(numbers[0], 2.5, before);
  results.Store2(0, asuint(float2(before, numbers[0])));

  numbers[1] = -0.0f * (z + 1);
  InterlockedCompareExchangeFloatBitwise(numbers[1], 0.0f, 1.0f, before);
  results.Store2(8, asuint(float2(before, numbers[1])));
  numbers[1] = asfloat(0x7FC00000 + z);
  InterlockedCompareExchangeFloatBitwise(numbers[1], asfloat(0x7FC00000), 1, before);
  results.Store2(16, asuint(float2(before, numbers[1])));

  items[1].weights.y = 0.5;
  InterlockedExchange(items[1].weights.y, 4, before);
  results.Store2(24, asuint(float2(before, items[1].weights.y)));

  raw.Store(16, asuint(4.0f));
  raw.InterlockedExchangeFloat(16 + z, 6, before);
  raw.InterlockedCompareStoreFloatBitwise(16 + z, 6, 7);
  float last;
  raw.InterlockedCompareExchangeFloatBitwise(16 + z, 7, 8, last);
  results.Store2(32, asuint(float2(before, asfloat(raw.Load(16)))));
  // The original value may have another type.
  uint number;
  numbers[2] = 3.75;
  InterlockedExchange(numbers[2], 1, number);
  results.Store(40, number);
}
