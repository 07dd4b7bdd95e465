// SPDX-License-Identifier: MIT
// FEATURE: core typedef
// EXPECT f32 0 3.0
// EXPECT u32 4 5
// EXPECT u32 8 6
typedef float3 Color;
typedef uint Pair[2];
typedef struct Named_ {
  uint a;
} Named;
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Color c = Color(1, 2, 3) + z;
  Pair p = {4, 5};
  Named n = {6};
  results.Store(0, asuint(c.z));
  results.Store2(4, uint2(p[1], n.a));
}
