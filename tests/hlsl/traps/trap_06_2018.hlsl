// SPDX-License-Identifier: MIT
// TRAP: 6 logic on scalars stops early
// OPTIONS: -HV 2018
// EXPECT u32 0 3
// EXPECT u32 4 1
// EXPECT u32 8 0
// EXPECT u32 12 0
// EXPECT u32 16 1
// EXPECT u32 20 1
// EXPECT u32 24 0
// EXPECT f32 28 1
// EXPECT f32 32 5
// EXPECT f32 36 3
static uint calls = 0;
bool touch(bool result) {
  calls += 1;
  return result;
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  // Before HLSL 2021, both sides are evaluated and vectors are allowed.
  bool a = z == 1 && touch(true);
  bool b = z == 0 || touch(false);
  bool c = z == 0 ? true : touch(false);
  results.Store(0, calls);
  bool3 left = bool3(true, z == 1, false);
  bool3 right = bool3(true, true, z == 1);
  results.Store3(4, (uint3)(left && right));
  results.Store3(16, (uint3)(left || right));
  results.Store3(28, asuint((left || !right) ? float3(1, 2, 3) : float3(4, 5, 6)));
}
