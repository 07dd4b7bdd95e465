// SPDX-License-Identifier: MIT
// FEATURE: core overload ranks
// EXPECT u32 0 11
// EXPECT u32 4 21
// EXPECT u32 8 31
// EXPECT u32 12 41
// EXPECT u32 16 42
// EXPECT u32 20 41
// EXPECT u32 24 42
// EXPECT f32 28 0.5
// EXPECT u32 32 51
// EXPECT u32 36 61
// EXPECT u32 40 71
// EXPECT u32 44 81
// EXPECT i32 48 -7
// EXPECT u32 52 91
// EXPECT u64 56 9223372036854775806
RWByteAddressBuffer results : register(u0);

// A splat before a truncation.
uint shape(float3 a, float3 b) { return 11; }
uint shape(float a, float b) { return 12; }
// unsigned to signed before integer to float
uint kind(int2 a) { return 21; }
uint kind(float2 a) { return 22; }
// signed to unsigned before integer to float
uint drop(uint a) { return 31; }
uint drop(float a) { return 32; }
// half and float are different types, with and without 16-bit types.
uint precision(half3 a) { return 41; }
uint precision(float3 a) { return 42; }
half doubled(half a) { return a * 2; }
float doubled(float a) { return a * 4; }
// more bits before fewer
uint width(double a) { return 51; }
uint width(half a) { return 52; }
// A splat before float to integer.
uint narrow(float2 a) { return 61; }
uint narrow(int a) { return 62; }
// The sum decides: one dear step costs more than several cheap ones.
uint sum(int64_t a, double b, uint c) { return 71; }
uint sum(int a, float b, float c) { return 72; }
// bool to int costs what bool to float does, so the splat decides.
uint flag(int a) { return 81; }
uint flag(float3 a) { return 82; }
// out parameters cost the way back.
void give(out int a) { a = -7; }
void give(out float a) { a = 9; }
template <typename T> uint generic(T a) { return 92; }
uint generic(float a) { return 91; }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const float f = 1 + z;
  const half h = 0.25 + z;
  const int i = z;
  const float3 f3 = f;
  const half3 h3 = h;
  results.Store3(0, uint3(shape(f3, f), kind(uint2(z, z)), drop(i)));
  results.Store4(12, uint4(precision(h3), precision(f3), precision(h3 * 2.0), precision(h3 * f)));
  results.Store(28, asuint((float)doubled(h)));
  results.Store4(32, uint4(width(f), narrow(f), sum(i, f, i), flag(z == 0)));
  int given;
  give(given);
  results.Store2(48, uint2(asuint(given), generic(f)));
  // 64 and 32 bits, signed and unsigned: unsigned, of 64 bits.
  const int64_t minus = -3 + (int64_t)z;
  results.Store<uint64_t>(56, (minus + z) / 2);
}
