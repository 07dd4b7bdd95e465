// SPDX-License-Identifier: MIT
// FEATURE: extended struct inheritance
// EXPECT u32 0 5
// EXPECT u32 4 5
// EXPECT u32 8 9
// EXPECT u32 12 500
// EXPECT u32 16 5
struct Base {
  uint a;
  uint get() { return a; }
  void set(uint x) { a = x; }
};
struct Derived : Base {
  uint b;
  uint sum() { return get() + b; }
};
uint of_base(Base base) { return base.a * 100; }
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Derived d;
  d.a = 3 + z;
  d.b = 4;
  d.set(5);
  results.Store4(0, uint4(d.a, d.get(), d.sum(), of_base(d)));
  Base copy = (Base)d;
  results.Store(16, copy.a);
}
