// SPDX-License-Identifier: MIT
// FEATURE: core auto
// EXPECT f32 0 1.5
// EXPECT u32 4 3
// EXPECT f32 8 6
// EXPECT u32 12 9
// EXPECT u32 16 11
// EXPECT u32 20 14
struct Pair {
  uint a;
  uint b;
};
static const auto kThree = 3u;
uint which(int x) { return 9; }
uint which(float x) { return 8; }
Pair make(uint a) {
  Pair p = {a, a + 1};
  return p;
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  auto f = 1.5;
  f += z;
  const auto v = float3(1, 2, 3) + z;
  auto i = 1;
  auto p = make(5 + z);
  float list[2] = {4 + z, 10};
  auto copy = list;
  copy[0] += p.a - 5;
  results.Store4(0, uint4(asuint(f), kThree + z, asuint(v.x + v.y + v.z), which(i)));
  for (auto k = 0u; k < 2; ++k) p.b += copy[k] * 0 + k;
  results.Store2(16, uint2(p.a + p.b - 1, copy[0] + copy[1]));
}
