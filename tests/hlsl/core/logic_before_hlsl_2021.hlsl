// SPDX-License-Identifier: MIT
// FEATURE: core logic before HLSL 2021
// OPTIONS: -HV 2018
// EXPECT u32 0 2
// EXPECT u32 4 0
// EXPECT u32 8 5
// EXPECT f32 12 1.0
// EXPECT f32 16 4.0
static uint calls = 0;
bool touch() {
  calls += 1;
  return true;
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  bool a = z == 1 && touch();
  uint b = z == 0 ? 5 : (touch() ? 6 : 7);
  bool2 c = bool2(true, z == 1) && bool2(true, true);
  float2 d = c ? float2(1, 2) : float2(3, 4);
  results.Store3(0, uint3(calls, a, b));
  results.Store2(12, asuint(d));
}
