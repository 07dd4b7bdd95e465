// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic log
// EXPECT f32 0 0.6931471805599453 4
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(log(2.0 + z)));
}
