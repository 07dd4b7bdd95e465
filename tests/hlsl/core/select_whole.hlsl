// SPDX-License-Identifier: MIT
// FEATURE: core select of samplers and structs
// EXPECT u32 0 3
// EXPECT u32 4 6
// EXPECT f32 8 4
// EXPECT u32 12 8
// EXPECT u32 16 1
RWByteAddressBuffer results : register(u0);

struct Pair {
  float a;
  int2 b;
};

static int calls = 0;
Pair made(int first) {
  ++calls;
  Pair pair = {first, int2(first + 1, first + 2)};
  return pair;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const Pair x = made(1);
  const Pair y = made(4);
  results.Store(0, select(z == 0, x, y).b.y);
  Pair chosen = select(z != 0, x, y);
  results.Store(4, chosen.b.y);
  results.Store(8, asuint(chosen.a));
  int first[2] = {7, 8};
  int second[2] = {9, 10};
  int both[2] = select(z == 0, first, second);
  results.Store(12, both[1]);
  // Both sides are evaluated.
  calls = 0;
  const Pair last = select(z == 0, made(1), made(2));
  results.Store(16, calls == 2 ? (uint)last.a : 99);
}
