// SPDX-License-Identifier: MIT
// FEATURE: core enum class
// EXPECT u32 0 7
// EXPECT u32 4 1
// EXPECT u32 8 0
// EXPECT u32 12 1
enum class Mode : uint { kOff, kOn = 7 };
uint f(Mode mode) {
  return mode == Mode::kOn ? 1 : 0;
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Mode mode = Mode::kOn;
  results.Store3(0, uint3((uint)mode, f(mode), f(Mode::kOff)));
  results.Store(12, f((Mode)(z + 7)));
}
