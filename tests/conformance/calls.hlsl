// SPDX-License-Identifier: MIT
// Callables.
#include "common.hlsli"

struct Number {
  uint value;
};

// Calls the index in the ray's `contribution`; writes what came back and its own ordinal.
[shader("raygeneration")]
void CallOne() {
  Number number;
  number.value = 77;
  CallShader(rays[0].contribution, number);
  words.Store(0, number.value);
  words.Store(4, ordinal);
}

[shader("callable")]
void Answer(inout Number number) {
  number.value = ordinal;
}

// Calls what its first constant after the ordinal says, and adds its own ordinal afterwards.
[shader("callable")]
void Forward(inout Number number) {
  const uint mine = ordinal;
  CallShader(reportedKind, number);
  number.value += mine == ordinal ? 100 * mine : 1000000;
}
