// SPDX-License-Identifier: MIT
// FEATURE: core vectors and matrices of other sizes
// EXPECT i32 0 3
// EXPECT i32 4 3
// EXPECT i32 8 7
// EXPECT f32 12 11
// EXPECT f32 16 22
// EXPECT f32 20 3
// EXPECT f32 24 12
// EXPECT f32 28 3
// EXPECT f32 32 4
// EXPECT f32 36 4
// EXPECT f32 40 3.5
// EXPECT f32 44 0
// EXPECT f32 48 625 4
// EXPECT f32 52 8
// EXPECT f32 56 0.5
// EXPECT f32 60 8
// EXPECT f32 64 3
// EXPECT f32 68 5
// EXPECT f32 72 40
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const int4 v4 = int4(1, 2, 3, 4) + (int)z;
  results.Store(0, ((int1x3)v4)._13);
  results.Store(4, ((int3x1)v4)._31);
  const int4x1 column = int4x1(5, 6, 7, 8 + z);
  results.Store(8, ((int3)column).z);
  const float2 sum = float2(1, 2) + float4x1(10, 20, 30, 40 + z);
  results.Store2(12, asuint(sum));
  const float1x1 one = 3 + z;
  const float4 splat = one;
  results.Store(20, asuint(splat.w));
  results.Store(24, asuint((one * float2x2(1, 2, 3, 4))._22));
  // Functions take what two matrices have in common.
  const float2x3 a = float2x3(1, 2, 3, 4, 5, 6) + z;
  const float3x2 b = float3x2(1, 2, 3, 4, 5, 6) + z;
  results.Store(28, asuint(min(a, b)._21));
  results.Store(32, asuint(max(b, a)._21));
  results.Store(36, asuint(clamp(a, b * 0, b)._22));
  results.Store(40, asuint(lerp(a, b, 0.5)._21));
  results.Store(44, asuint(step(a, b)._21));
  results.Store(48, asuint(pow(a, b)._22));
  results.Store(52, asuint(ldexp(a, b)._12));
  results.Store(56, asuint(smoothstep(a * 0, b, a * 0.5)._11));
  const float1 two = 2 + z;
  results.Store(60, asuint(mul(two, float4x4(1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4))._44));
  results.Store(64, asuint(determinant(3.0 + z)));
  results.Store(68, asuint(transpose(5.0 + z)._11));
  // The left operand decides where both have as many components.
  results.Store(72, asuint((float4x1(1, 2, 3, 4) * float4(10, 10, 10, 10 + z))._41));
}
