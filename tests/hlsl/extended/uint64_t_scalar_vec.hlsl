// SPDX-License-Identifier: MIT
// FEATURE: extended uint64_t scalar/vec
// EXPECT u32 0 1
// EXPECT u32 4 3
// EXPECT u32 8 4294967294
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint64_t a = 0x100000000ull + z;
  a = a * 3 + 1;
  results.Store2(0, uint2((uint)a, (uint)(a >> 32)));
  int64_t b = -5;
  results.Store(8, asuint((int)(b / 2)));
}
