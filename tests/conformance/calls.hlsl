// SPDX-License-Identifier: MIT
// Callable shaders.
#include "common.hlsli"

struct Number {
  uint value;
};

// Calls the shader at the ray's `contribution`; writes what it returned and its own ordinal.
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

// Calls the shader that the constant after its ordinal names, then adds its own ordinal.
[shader("callable")]
void Forward(inout Number number) {
  const uint mine = ordinal;
  CallShader(reportedKind, number);
  number.value += mine == ordinal ? 100 * mine : 1000000;
}
