// SPDX-License-Identifier: MIT
// FEATURE: core names of types, semantics and sizes
// EXPECT f32 0 7
// EXPECT u32 4 9
// EXPECT u32 8 1
// EXPECT u32 12 5
// EXPECT u32 16 6
// EXPECT u32 20 0xFFFFFFFF
// EXPECT u32 24 0x01FFFFFF
// EXPECT u32 28 8
// EXPECT u32 32 15
// EXPECT u32 36 1
// EXPECT u32 40 7
// EXPECT u32 44 4
// EXPECT u32 48 8
RWByteAddressBuffer results : register(u[0]);

cbuffer Constants : register(b0) {
  uint first : packoffset(c[1].y);  // word i is i
  uint second : packoffset(c0[1].z);
};

typedef int Index;
static const uint N = 7;
// A name behind the colon is a semantic, even if it is that of a number.
struct Named {
  uint a : N;
  uint b : (32 - N);
};
struct Sized {
  uint a : sizeof(uint);
  uint b : true ? 1 : 2;
  uint c : int(3);
};

struct Holder {
  uint uint2;
  float float3;
};
float twice(float half3 : TEXCOORD0 : TEXCOORD1) { return half3 * 2; }
uint number(uint a, out uint b = 1, inout uint c = 5) {
  b = a;
  return a + c;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Holder holder = {3 + z, 0.5};
  float float1 = twice(holder.uint2);
  results.Store(0, asuint(float1 + holder.float3 * 2));
  uint int1x1 = 4 + z;
  results.Store(4, int1x1 + 5);
  unsigned Index i = -1 - (int)z;
  results.Store(8, i >> 31);
  results.Store(12, first);
  results.Store(16, second);
  Named named;
  named.a = ~z;
  named.b = ~z;
  results.Store(20, named.a);
  results.Store(24, named.b);
  results.Store(28, sizeof(Named));
  Sized sized;
  sized.a = ~z;
  sized.b = ~z;
  sized.c = ~z;
  results.Store(32, sized.a);
  results.Store(36, sized.b);
  results.Store(40, sized.c);
  results.Store(44, sizeof(Sized));
  results.Store(48, number(3 + z));
}
