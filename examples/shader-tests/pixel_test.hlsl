// SPDX-License-Identifier: MIT
// What only pixel shaders have: derivatives across a quad, and what of a quad is drawn.
#include <kaamos/test.hlsli>

// The width of one step of a stripe pattern on the screen, for filtering it.
float stripe_width(float2 uv) {
  return fwidth(uv.x * 8);
}

[test("pixel")]
void PositionsAreCentresOfPixels(float4 position : SV_Position) {
  EXPECT_EQ(frac(position.xy), 0.5);
  EXPECT_EQ(position.zw, float2(0.5, 1));
  EXPECT_LT(position.xy, 2);
}

// Across the quad x grows by 1, and x * y by the other coordinate.
[test("pixel")]
void DerivativesAreDifferencesInTheQuad(float4 position : SV_Position) {
  EXPECT_EQ(ddx(position.xy), float2(1, 0));
  EXPECT_EQ(ddy(position.xy), float2(0, 1));
  EXPECT_EQ(ddx_fine(position.x * position.y), position.y);
  EXPECT_EQ(ddy_fine(position.x * position.y), position.x);
}

[test("pixel")]
[dispatch(8, 4)]
void StripesHaveOneWidthEverywhere(float4 position : SV_Position) {
  EXPECT_NEAR(stripe_width(position.xy / 8), 1, 1e-6);
}

[test("pixel")]
[dispatch(3, 1)]
void PixelsOutsideAreHelpers(float4 position : SV_Position) {
  EXPECT_FALSE(IsHelperLane());
  EXPECT_EQ(QuadReadAcrossX(1u), 1u);
}

[test("pixel")]
void FrontsAreDrawn(float4 position : SV_Position, bool front : SV_IsFrontFace) {
  EXPECT_TRUE(front);
}
