// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic radians
// EXPECT f32 0 3.14159265 2
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(radians(180.0 + z)));
}
