// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic step
// EXPECT f32 0 1.0
// EXPECT f32 4 0.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(step(0.5, 0.5 + z)));
  results.Store(4, asuint(step(0.5, 0.25)));
}
