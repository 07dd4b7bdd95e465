// SPDX-License-Identifier: MIT
// TRAP: 8 integers and floats
// EXPECT u32 0 1
// EXPECT u32 4 2147483648
// EXPECT u32 8 1
// EXPECT u32 12 4294967295
// EXPECT u32 16 1
// EXPECT u32 20 2147483648
// EXPECT u64 24 1
// EXPECT u64 32 8589934592
// EXPECT u64 40 18446744073709551615
// EXPECT u32 48 4294967295
// EXPECT u32 52 4294967295
// EXPECT u32 56 2
// EXPECT u32 60 1
// EXPECT u32 64 1
// EXPECT u32 68 1
// EXPECT u32 72 4294967295
// EXPECT f32 76 1.5
// EXPECT f32 80 -1.5
// EXPECT f32 84 1.5
// EXPECT f32 88 nan
// EXPECT f32 92 nan
// EXPECT i32 96 3
// EXPECT i32 100 -3
// EXPECT i32 104 -3
// EXPECT u32 108 0
// EXPECT u32 112 0
// EXPECT u32 116 4294967295
// EXPECT u32 120 4294967295
// EXPECT i32 124 2147483647
// EXPECT i32 128 -2147483648
// EXPECT i32 132 -2147483648
// EXPECT i32 136 0
// EXPECT u32 140 1
// EXPECT u32 144 2147483648
// EXPECT u32 148 4294967295
// DXC's validator refuses the constants, whose values HLSL leaves undefined.
// The compiler and the shader must compute the same value.
static const uint kShift = 1u << 32;
static const uint kMinusShift = 1u << -1;
static const uint kDivision = 7u / 0u;
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const uint s = 32 + z;
  const int m = -1 + (int)z;
  results.Store4(0, uint4(1u << s, 1u << m, 0x80000000u >> (s - 1), asuint(int(0x80000000) >> (s - 1))));
  results.Store2(16, uint2(1u << (s + 32), asuint(1 << (s + 31))));
  const uint64_t one = 1 + z;
  results.Store<uint64_t>(24, one << 64);
  results.Store<uint64_t>(32, one << 33);
  results.Store<uint64_t>(40, one / (uint64_t)z);
  const uint4 divided = uint4(5, 0, 6, 7) / uint4(z, z, 3, 4);
  results.Store4(48, divided);
  results.Store3(64, uint3(5, 9, 3) % uint3(2, 4, z));
  const float f = 7.5 + z;
  results.Store4(76, asuint(float4(f % 2, -f % 2, f % -2, f % (float)z)));
  results.Store(92, asuint(fmod(f, (float)z)));
  results.Store3(96, asuint(int3(7 % (-4 + (int)z), -7 % (4 + (int)z), -7 % (-4 + (int)z))));
  const float huge = asfloat(0x7f800000 + z);
  results.Store4(108, uint4((uint)-huge, (uint)(-0.9 + z), (uint)huge, (uint)(4294967296.0 + z)));
  results.Store4(124, asuint(int4((int)huge, (int)-huge, (int)(-3e9 + z), (int)(huge - huge))));
  results.Store3(140, uint3(kShift, kMinusShift, kDivision));
  // Undefined, but must not end the program.
  const int lowest = asint(0x80000000 + z);
  results.Store4(160, asuint(int4(lowest / m, lowest % m, 5 / (int)z, 5 % (int)z)));
}
