// SPDX-License-Identifier: MIT
// FEATURE: core bounded resource array T x[N]
// EXPECT f32 0 10 20 30
// EXPECT f32 12 10 40 20
// EXPECT u32 24 2
RWTexture2D<float4> pictures[3] : register(u0, space1);
RWByteAddressBuffer results : register(u0);

uint Next(inout uint n) { return n++; }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  for (uint k = 0; k < 3; ++k) pictures[k + z][uint2(k, 0)] = 10.0 * (k + 1);
  for (uint j = 0; j < 3; ++j) results.Store(4 * j, asuint(pictures[j][uint2(j + z, 0)].x));
  // The array element is chosen before the coordinates' side effect changes its index.
  uint i = z;
  results.Store(12, asuint(pictures[i][uint2(Next(i), 0)].x));
  pictures[i][uint2(Next(i), 0)] = 40.0;
  results.Store(16, asuint(pictures[1][uint2(1, 0)].x));
  pictures[1][uint2(1, 0)] = 20.0;
  results.Store(20, asuint(pictures[1 + z][uint2(1, 0)].x));
  results.Store(24, i);
}
