// SPDX-License-Identifier: MIT
// FEATURE: compute waves in a switch
// EXPECT u32 0 21 20 100 1000
// EXPECT u32 16 4 4 4 4
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  uint a = z;
  switch (i) {
    case 0:
      a += WaveActiveCountBits(true);
    case 1:
      a += 10 * WaveActiveCountBits(true);
      break;
    case 2:
      a += 100 * WaveActiveCountBits(true);
      break;
    default:
      a += 1000 * WaveActiveCountBits(true);
  }
  results.Store(4 * i, a);
  results.Store(16 + 4 * i, WaveActiveCountBits(true));
}
