// SPDX-License-Identifier: MIT
// A compute shader that the project compiles by a command.
RWStructuredBuffer<uint> numbers : register(u0);

[numthreads(32, 1, 1)]
void Fill(uint i : SV_DispatchThreadID) {
  numbers[i] = i;
}
