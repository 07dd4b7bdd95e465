// SPDX-License-Identifier: MIT
// FEATURE: core parts of constants that are zero
// EXPECT f32 0 1
// EXPECT f32 4 2
// EXPECT f32 8 3
// EXPECT f32 12 4
// EXPECT f32 16 5
// EXPECT f32 20 6
RWByteAddressBuffer results : register(u0);

struct Empty {};
struct Inner {
  float2 a;
  uint b[3];
  Empty c;
};
struct Outer {
  float4x3 m;
  Inner inner[2];
};

static const float numbers[3] = (float[3])0;
static const float2 pairs[2][4] = (float2[2][4])0;
static const float3x1 matrices[2] = (float3x1[2])0;
static const Outer outer = (Outer)0;
static const Outer mixed[2] = {{(float4x3)4, (Inner[2])0}, (Outer)0};
static const float many[600] = (float[600])0;

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(numbers[1] + numbers[1 + z] + 1));
  results.Store(4, asuint(pairs[1][2].y + pairs[z][z].x + 2));
  results.Store(8, asuint(matrices[1][2][0] + matrices[z][0][0] + 3));
  results.Store(12, asuint(outer.m[3].y + outer.inner[1].b[2] + outer.inner[z].a.x + 4));
  results.Store(16, asuint(mixed[0].m[1].x + mixed[0].inner[1].a.y + mixed[1].inner[0].b[1] + 1));
  results.Store(20, asuint(many[543] + many[z] + 6));
}
