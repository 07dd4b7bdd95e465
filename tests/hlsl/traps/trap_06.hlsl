// SPDX-License-Identifier: MIT
// TRAP: 6 logic on scalars stops early
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 3
// EXPECT f32 12 1.0
// EXPECT f32 16 4.0
// EXPECT u32 20 1
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
  bool b = z == 0 || touch();
  bool c = z == 0 ? true : touch();
  results.Store(0, calls);
  bool d = z == 0 && touch();
  results.Store2(4, uint2(calls, a + b + c + d));
  results.Store2(12, asuint(select(bool2(true, false), float2(1, 2), float2(3, 4))));
  results.Store(20, all(and(bool2(true, true), bool2(z == 0, true))));
}
