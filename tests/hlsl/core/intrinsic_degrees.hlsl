// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic degrees
// EXPECT f32 0 180.0 2
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(degrees(3.14159265 + z)));
}
