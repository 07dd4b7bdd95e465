// SPDX-License-Identifier: MIT
// FEATURE: compute WavePrefixProduct
// EXPECT u32 0 1 5 10 110
// EXPECT u32 16 1 1 5 55
// EXPECT i32 32 1 -1 4 20
// EXPECT f32 48 1.0 -0.5 1.0 2.5
// EXPECT u32 64 1 1 5 8 10 40 110 560
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store(4 * i, WavePrefixProduct(v));
  if (i != 1) {
    results.Store(16 + 4 * i, WavePrefixProduct(v));
  } else {
    results.Store(16 + 4 * i, WavePrefixProduct(v + 100));
  }
  results.Store(32 + 4 * i, asuint(WavePrefixProduct(int(v) - 6)));
  results.Store(48 + 4 * i, asuint(WavePrefixProduct((float(v) - 6) * 0.5)));
  results.Store2(64 + 8 * i, WavePrefixProduct(uint2(v, v + 3)));
}
