// SPDX-License-Identifier: MIT
// FEATURE: extended template<>
// EXPECT u32 0 3
// EXPECT f32 4 2.5
// EXPECT u32 8 8
// EXPECT u32 12 7
// EXPECT u32 16 64
template <typename T>
T largest(T a, T b) {
  return a > b ? a : b;
}
template <typename T, int N>
struct Stack {
  T items[N];
  int count;
  void push(T item) { items[count++] = item; }
  T pop() { return items[--count]; }
};
template <int N>
uint power(uint x) {
  uint r = 1;
  for (int i = 0; i < N; ++i) r *= x;
  return r;
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, largest(3u, z + 2));
  results.Store(4, asuint(largest<float>(1, 2.5)));
  Stack<uint, 4> stack;
  stack.count = 0;
  stack.push(7);
  stack.push(8);
  results.Store2(8, uint2(stack.pop(), stack.pop()));
  results.Store(16, power<3>(4));
}
