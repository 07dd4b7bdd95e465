// SPDX-License-Identifier: MIT
// FEATURE: core .Length of arrays, `using namespace dx` where it is empty
// EXPECT u32 0 8 3 5
using namespace dx;
RWByteAddressBuffer results : register(u0);
static const float4 all[8] = (float4[8])0;

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float rows[3][5] = (float[3][5])0;
  results.Store3(0, uint3(all.Length, rows.Length, rows[0].Length) + z);
}
