// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic atan
// EXPECT f32 0 0.4636476090008061 8
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(atan(0.5 + z)));
}
