// SPDX-License-Identifier: MIT
// FEATURE: core struct methods
// EXPECT u32 0 7
// EXPECT u32 4 14
// EXPECT u32 8 16
// EXPECT u32 12 8
// EXPECT u32 16 9
struct Counter {
  uint value;
  void add(uint x) { value += x; }
  uint twice() { return value * 2; }
  static uint zero() { return 0; }
};
struct Holder {
  Counter counter;
  uint total() { counter.add(1); return counter.twice(); }
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Counter c = {3};
  c.add(4 + z);
  results.Store2(0, uint2(c.value, c.twice()));
  Holder h;
  h.counter = c;
  results.Store2(8, uint2(h.total(), h.counter.value));
  results.Store(16, Counter::zero() + 9);
}
