// SPDX-License-Identifier: MIT
// FEATURE: compute derivatives in quads of squares
// f = 3 x + 10 y + x y, over (0 to 3, 0 to 1): 0 3 6 9, 10 14 18 22.
// The first quad is x 0 and 1, the second 2 and 3. ddx_fine: 3 3 3 3, 4 4 4 4.
// EXPECT f32 0 3 3 3 3 4 4 4 4
// ddy_fine: 10 11 12 13 in both rows.
// EXPECT f32 32 10 11 12 13 10 11 12 13
// Coarse ones are those of the upper left thread; ddx and ddy are coarse.
// EXPECT f32 64 3 3 3 3 3 3 3 3
// EXPECT f32 96 10 10 12 12 10 10 12 12
// fwidth is the sum of both.
// EXPECT f32 128 13 13 15 15 13 13 15 15
// A vector, in a function; the matrix by rows. 5 x + 7 y has the derivatives 5 and 7.
// EXPECT f32 160 12 12 12 12 12 12 12 12
// EXPECT f32 192 24 24 24 24 24 24 24 24
// Derivatives of what does not change stay right under a condition that not all threads meet.
// EXPECT f32 224 0 1 0 1 0 1 0 1
RWByteAddressBuffer results : register(u0);

float both(float2 v) {
  return ddx(v).x + ddy_fine(v).y;
}

[shader("compute")]
[numthreads(4, 2, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  const float2 at = id.xy + results.Load(65532);
  const float f = 3 * at.x + 10 * at.y + at.x * at.y;
  const float wanted = at.x;
  results.Store(4 * i, asuint(ddx_fine(f)));
  results.Store(32 + 4 * i, asuint(ddy_fine(f)));
  results.Store(64 + 4 * i, asuint(ddx_coarse(f)));
  results.Store(96 + 4 * i, asuint(ddy(f)));
  results.Store(128 + 4 * i, asuint(fwidth(f)));
  results.Store(160 + 4 * i, asuint(both(at * float2(5, 7))));
  const float2x2 m = float2x2(at * 5, at * 7);
  results.Store(192 + 4 * i, asuint(ddx(m)[0][0] + ddx(m)[1][0] + ddy(m)[0][1] + ddy(m)[1][1]));
  if (id.x & 1) results.Store(224 + 4 * i, asuint(ddx(wanted)));
}
