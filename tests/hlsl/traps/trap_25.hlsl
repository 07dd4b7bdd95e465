// SPDX-License-Identifier: MIT
// TRAP: 25 uninitialised variables are zero
// EXPECT u32 0 0
// EXPECT u32 4 0
// EXPECT u32 8 0
// EXPECT u32 12 0
// EXPECT u32 16 0
// EXPECT u32 20 0
// EXPECT u32 24 0
// DXC's validator is right to refuse it: HLSL leaves the values undefined.
struct S {
  float3 a;
  uint b[2];
};
void give(out uint x, uint y) {
  if (y > 0) x = y;
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  S s;
  float f;
  uint u[4];
  results.Store3(0, asuint(s.a));
  results.Store2(12, uint2(s.b[1], asuint(f)));
  uint given = 9;
  give(given, z);
  results.Store2(20, uint2(u[3], given));
}
