// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic log10
// EXPECT f32 0 3.0 4
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(log10(1000.0 + z)));
}
