// SPDX-License-Identifier: MIT
// FEATURE: core character literal
// EXPECT u32 0 97
// EXPECT u32 4 10
// EXPECT u32 8 0
// EXPECT u32 12 39
// EXPECT u32 16 65
// EXPECT u32 20 92
// EXPECT u32 24 0xFFFFFFFF
// EXPECT u32 28 83
// EXPECT u32 32 5
// EXPECT u32 36 1
// EXPECT u32 40 0xFFFFFFFF
// EXPECT u32 44 7
// EXPECT u32 48 34
RWByteAddressBuffer results : register(u0);

uint type_of(uint value) { return 1; }
uint type_of(int value) { return 2; }
uint type_of(float value) { return 3; }

uint digit(uint c) {
  switch (c) {
    case '0': return 0;
    case '7': return 7;
    default: return 99;
  }
}

#if 'A' != 65 || '\n' != 10
#error a character in a condition is its number
#endif

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, 'a' + z);
  results.Store4(4, uint4('\n', '\0', '\'', '\x41') + z);
  results.Store(20, '\\' + z);
  // A byte from 128 on is negative before it becomes a uint.
  results.Store(24, '\xff' + z);
  results.Store(28, '\123' + z);
  uint digits[3] = {'3', '4', '5'};
  results.Store(32, digits[2 + z] - '0');
  results.Store(36, type_of('a') + z);
  results.Store(40, 'a' - 'b' + z);
  results.Store(44, digit('0' + 7 + z));
  results.Store(48, '"' + z);
}
