// SPDX-License-Identifier: MIT
// FEATURE: core scope of a name begins before its initialiser
// EXPECT u32 0 0 7 9 4
// The name in the initialiser is the new variable, as in C, which is zero there.
RWByteAddressBuffer results : register(u0);

struct Pair {
  uint a;
  uint b;
};

Pair make(uint a, uint b) {
  Pair pair;
  pair.a = a;
  pair.b = b;
  return pair;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint x = 5 + z;
  {
    uint x = x;
    results.Store(0, x);
  }
  Pair p = p = make(7 + z, 9);
  results.Store2(4, uint2(p.a, p.b));
  const uint y = x + y - 1;
  results.Store(12, y);
}
