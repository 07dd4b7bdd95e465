// SPDX-License-Identifier: MIT
// FEATURE: core precise
// EXPECT f32 0 4.5
precise float f(float a, float b) {
  precise float r = a * b + a;
  return r;
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(f(1.5 + z, 2)));
}
