// SPDX-License-Identifier: MIT
// FEATURE: core conversions of structs before HLSL 2021
// OPTIONS: -HV 2018
// EXPECT f32 0 4
// EXPECT f32 4 6
// EXPECT f32 8 2
// EXPECT f32 12 9
// EXPECT u32 16 5
RWByteAddressBuffer results : register(u0);
Buffer<uint> views[2] : register(t0);  // word i is i

struct Vertex {
  float4 position;
  float2 a[2];
};
struct Interpolants {
  float3 position;
  float depth;
  float4 a;
};
struct Empty {};
struct Padded {
  Empty before;
  float a;
  Empty between;
  float b;
  Empty after;
};

float sum(Interpolants v) { return v.position.y + v.depth; }
// The size of a parameter's array does not matter.
uint read(Buffer<uint> b[], uint i) { return b[0][i]; }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Vertex v = {1, 2, 3, 4, 5, 6, 7, 8 + z};
  Interpolants i;
  i = v;
  results.Store(0, asuint(i.depth));
  results.Store(4, asuint(sum(v)));
  const Padded padded = {2 + z, 9};
  results.Store(8, asuint(padded.a));
  results.Store(12, asuint(padded.b));
  results.Store(16, read(views, 5 + z));
}
