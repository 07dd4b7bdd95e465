// SPDX-License-Identifier: MIT
// TRAP: 18 callable data of several types
// EXPECT u32 0 7
// EXPECT u32 4 7
struct A {
  uint x;
};
[shader("callable")]
void Call(inout A a) {
  a.x = a.x * 2 + 1;
}
uint through(uint x) {
  A a = {x};
  CallShader(0, a);
  return a.x;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store2(0, uint2(through(3), through(through(1))));
}
