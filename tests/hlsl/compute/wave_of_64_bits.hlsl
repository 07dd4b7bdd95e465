// SPDX-License-Identifier: MIT
// FEATURE: compute waves of 64-bit types
// EXPECT u32 0 26 26 26 26 26 26 26 26
// EXPECT u32 32 0 0 5 5 7 7 18 18
// EXPECT u32 64 4294967285 4294967284 4294967285 4294967284 4294967285 4294967284 4294967285 4294967284
// EXPECT u32 96 4 4 4 4 4 4 4 4
// EXPECT u32 128 8 8 11 11 2 2 5 5
// EXPECT u32 160 5 10 5 10
// EXPECT u32 176 1024 1077542912 1024 1077542912 1024 1077542912 1024 1077542912
// EXPECT u32 208 512 1076232192 512 1076232192 512 1076232192 512 1076232192
// EXPECT u32 240 0 0 0 0 5 5 16 16
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  const uint64_t wide = uint64_t(v) << 32 | v;
  results.Store<uint64_t>(8 * i, WaveActiveSum(wide));
  results.Store<uint64_t>(32 + 8 * i, WavePrefixSum(wide));
  results.Store<int64_t>(64 + 8 * i, WaveActiveMin(-int64_t(wide)));
  results.Store<uint64_t>(96 + 8 * i, WaveActiveBitXor(wide));
  results.Store<uint64_t>(128 + 8 * i, WaveReadLaneAt(wide, 3 - i));
  results.Store(160 + 4 * i, WaveMatch(uint64_t(v & 1) << 40).x);
  const double fine = v + 9.094947017729282e-13L;  // 2^-40
  results.Store<double>(176 + 8 * i, WaveActiveSum(fine));
  results.Store<double>(208 + 8 * i, WaveActiveMax(fine));
  results.Store<uint64_t>(240 + 8 * i, WaveMultiPrefixSum(wide, WaveMatch(v > 4 ? 1 : 0)));
}
