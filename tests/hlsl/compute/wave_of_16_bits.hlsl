// SPDX-License-Identifier: MIT
// FEATURE: compute waves of 16-bit types
// OPTIONS: -enable-16bit-types
// EXPECT u32 0 19072 19072 19072 19072
// EXPECT u32 16 0 16640 17152 18560
// EXPECT i32 32 -11 -11 -11 -11
// EXPECT u32 48 2 2 2 2
// EXPECT u32 64 17408 17792 15360 16640
// EXPECT u32 80 15360 15360 15360 15360
// EXPECT u32 96 13 2 13 13
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  const float16_t half_v = float16_t(v) * float16_t(0.5);
  results.Store(4 * i, uint(asuint16(WaveActiveSum(half_v))));
  results.Store(16 + 4 * i, uint(asuint16(WavePrefixSum(half_v))));
  results.Store(32 + 4 * i, uint(int(WaveActiveMin(int16_t(-int(v))))));
  results.Store(48 + 4 * i, uint(WaveActiveSum(uint16_t(v + 65530))));
  results.Store(64 + 4 * i, uint(asuint16(WaveReadLaneAt(half_v, 3 - i))));
  results.Store(80 + 4 * i, uint(asuint16(WaveActiveMin(half_v))));
  results.Store(96 + 4 * i, WaveMatch(uint16_t(v > 4)).x);
}
