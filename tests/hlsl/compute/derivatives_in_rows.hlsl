// SPDX-License-Identifier: MIT
// FEATURE: compute derivatives in quads of rows
// Threads 0 to 3 are one quad, 4 to 7 the next: 0 and 1 above, 2 and 3 below. f = i * i.
// EXPECT f32 0 1 1 5 5 9 9 13 13
// EXPECT f32 32 4 8 4 8 20 24 20 24
// EXPECT f32 64 1 1 1 1 9 9 9 9
// EXPECT f32 96 4 4 4 4 20 20 20 20
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(8, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const float f = i * i + results.Load(65532);
  results.Store(4 * i, asuint(ddx_fine(f)));
  results.Store(32 + 4 * i, asuint(ddy_fine(f)));
  results.Store(64 + 4 * i, asuint(ddx(f)));
  results.Store(96 + 4 * i, asuint(ddy(f)));
}
