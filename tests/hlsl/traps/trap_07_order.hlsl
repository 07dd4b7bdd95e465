// SPDX-License-Identifier: MIT
// TRAP: 7 arguments are read from left to right
// EXPECT u32 0 112
// EXPECT u32 4 203
// EXPECT u32 8 3
RWByteAddressBuffer results : register(u0);
struct State {
  uint value;
};
uint next(inout State state) {
  return state.value++;
}
uint join(uint a, uint b, uint c) {
  return a * 100 + b * 10 + c;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  State state = {1 + results.Load(65532)};
  results.Store(0, join(state.value, next(state), state.value));
  uint i = 2;
  uint table[4] = {0, 1, 2, 3};
  results.Store(4, join(i, table[i - 2], table[++i]));
  results.Store(8, i);
}
