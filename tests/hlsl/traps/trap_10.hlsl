// SPDX-License-Identifier: MIT
// TRAP: 10 precise keeps products apart from sums
// EXPECT f32 0 0.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  precise float a = asfloat(0x3f800001 + z);
  precise float b = a * a - asfloat(0x3f800002);
  results.Store(0, asuint(b));
}
