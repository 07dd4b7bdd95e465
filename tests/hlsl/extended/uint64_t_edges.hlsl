// SPDX-License-Identifier: MIT
// FEATURE: extended uint64_t scalar/vec
// EXPECT u64 0 18446744073709551615
// EXPECT u64 8 1
// EXPECT u64 16 9223372036854775808
// EXPECT u64 24 4294967296
// EXPECT i32 32 -2
// EXPECT i32 36 -1
// EXPECT u64 40 18446744073709551615
// EXPECT f32 48 18446744073709551616
// EXPECT f32 52 0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const uint64_t one = 1 + z;
  results.Store<uint64_t>(0, (uint64_t)z - one);
  results.Store<uint64_t>(8, (~(uint64_t)z) >> 63);
  results.Store<uint64_t>(16, one << 127);
  results.Store<uint64_t2>(24, uint64_t2(one << 32, 0));
  const int64_t minus = -7 + (int)z;
  results.Store2(32, asuint(int2((int)(minus >> 2), (int)(minus % 2))));
  results.Store<uint64_t>(40, (uint64_t)(2e19 + z));
  results.Store(48, asuint((float)((uint64_t)z - one)));
  results.Store(52, asuint((float)(int64_t)asfloat(0x7fc00000 + z)));
}
