// SPDX-License-Identifier: MIT
// FEATURE: extended user semantic on struct member (: POSITION…)
// EXPECT f32 0 5.0
struct Vertex {
  float3 position : POSITION;
  float2 uv : TEXCOORD0;
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Vertex v = {float3(1, 2, 3), float2(4, 5)};
  results.Store(0, asuint(v.uv.y + z));
}
