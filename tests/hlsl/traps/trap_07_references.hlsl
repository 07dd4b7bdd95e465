// SPDX-License-Identifier: MIT
// TRAP: 7 copy-in: what a function is given stays what it was, also where it may be passed by reference
// EXPECT u32 0 1
// EXPECT u32 4 9
// EXPECT u32 8 2
// EXPECT u32 12 7
// EXPECT u32 16 5
// EXPECT u32 20 6
// EXPECT u32 24 4
// EXPECT u32 28 40
// EXPECT u32 32 3
// EXPECT u32 36 11
// EXPECT u32 40 21
// EXPECT u32 44 31
// EXPECT u32 48 8
// EXPECT u32 52 80
// EXPECT u32 56 13
// EXPECT u32 60 26
struct S {
  uint x;
  uint y;
};
static S global;
static uint numbers[2];
groupshared S shared_value;

// Changes the global that was passed as its argument.
uint before_write(S given) {
  global.x = 9;
  return given.x;
}
uint before_write_of_element(uint given[2]) {
  numbers[1] = 7;
  return given[1];
}
uint before_write_of_shared(S given) {
  shared_value.y = 6;
  return given.y;
}
// Two parameters, the same variable.
uint before_write_of_other(S given, inout S other) {
  other.x = 40;
  return given.x;
}
// Writes to its own copy, which its caller does not notice.
uint writes_its_own(S given) {
  given.x += 100;
  return given.x - 97;
}
// Passes its argument, which it only reads, on to a function that changes the global.
uint hands_on(S given) { return before_write(given) + given.x; }
S swapped(S given) {
  S result;
  result.x = given.y;
  result.y = given.x;
  return result;
}
uint of_matrix(uint2x2 given, inout uint2x2 other) {
  other[0][1] = 80;
  return given[0][1];
}
uint next(inout uint x) { return x++; }
uint sum(S given, uint more) { return given.x + more; }
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  global.x = 1 + z;
  results.Store2(0, uint2(before_write(global), 9));
  numbers[1] = 2 + z;
  const uint element = before_write_of_element(numbers);
  results.Store2(8, uint2(element, numbers[1]));
  shared_value.y = 5 + z;
  const uint of_shared = before_write_of_shared(shared_value);
  results.Store2(16, uint2(of_shared, shared_value.y));
  S s = {4 + z, 0};
  const uint of_other = before_write_of_other(s, s);
  results.Store2(24, uint2(of_other, s.x));
  S own = {z, 0};
  results.Store(32, writes_its_own(own) + own.x);
  S t = {21 + z, 11};
  t = swapped(t);
  results.Store2(36, uint2(t.x, t.y));
  global.x = 11 + z;
  results.Store(44, hands_on(global) + 9);
  uint2x2 m = {0, 8 + z, 0, 0};
  const uint of_matrix_before = of_matrix(m, m);
  results.Store2(48, uint2(of_matrix_before, m[0][1]));
  // A part that is read before a later operand changes it.
  S u = {13 + z, 0};
  const S kept = u;
  results.Store2(56, uint2(sum(kept, next(u.x)) - 13, sum(kept, 13)));
}
