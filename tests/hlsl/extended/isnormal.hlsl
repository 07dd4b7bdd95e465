// SPDX-License-Identifier: MIT
// FEATURE: extended intrinsic isnormal
// OPTIONS: -enable-16bit-types -T lib_6_9
// EXPECT u32 0 1 1 0 0 0 0 0
// EXPECT u32 28 1 0 0 0
// EXPECT u32 44 1 0 0 1
// EXPECT u32 60 1 1 0 0 1 0 0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  // The smallest normal number, the largest, the largest denormal, -0, infinity, NaNs.
  const uint bits[7] = {0x00800000, 0xFF7FFFFF, 0x007FFFFF, 0x80000000,
                        0xFF800000, 0x7FC00000, 0x7F800001};
  for (uint i = 0; i < 7; ++i) results.Store(4 * i, isnormal(asfloat(bits[i] + z)));
  // The same of halves, whose denormals are normal floats, and of doubles.
  const uint4 halves = uint4(0x8400, 0x03FF, 0x7C00, 0) + z;
  results.Store4(28, uint4(isnormal(asfloat16((uint16_t4)halves))));
  const uint4 high = uint4(0x00100000, 0x000FFFFF, 0x7FF00000, 0xFFEFFFFF) + z;
  results.Store4(44, uint4(isnormal(asdouble(z, high.x)), isnormal(asdouble(z, high.y)),
                           isnormal(asdouble(z, high.z)), isnormal(asdouble(z, high.w))));
  vector<float, 7> many;
  for (uint k = 0; k < 7; ++k) many[k] = asfloat(bits[k] + z);
  many[4] = 1;
  const vector<bool, 7> normal = isnormal(many);
  for (uint n = 0; n < 7; ++n) results.Store(60 + 4 * n, normal[n]);
}
