// SPDX-License-Identifier: MIT
// FEATURE: core struct
// EXPECT u32 0 7
// EXPECT u32 4 2
// Parts of results that are never used: the called functions still run, once each.
struct Pair {
  uint2 a;
  uint b[2];
};
static uint calls = 0;
Pair make() {
  calls += 1;
  return (Pair)0;
}
bool yes() {
  calls += 1;
  return true;
}
static uint others = 0;
uint count() { return others++; }
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  make().a;
  make().a.y;
  make().b[1];
  -make().b[0];
  !yes();
  yes() && yes();
  count();
  count() + 1;
  results.Store2(0, uint2(calls, others));
}
