// SPDX-License-Identifier: MIT
// What the frame's pictures store comes back.
#include <kaamos/test.hlsli>
#include "encoding.hlsli"

// 8,192 directions around the whole sphere, edges of the octahedron among them.
[test]
[numthreads(64, 1, 1)]
[dispatch(128)]
void DirectionsComeBack(uint i : SV_DispatchThreadID) {
  const float z = -1 + 2 * (float(i) + 0.5) / 8192;
  const float phi = float(i) * 2.3999632;
  const float3 n = float3(sqrt(1 - z * z) * cos(phi), sqrt(1 - z * z) * sin(phi), z);
  const float2 code = OctahedralEncode(n);
  EXPECT_LE(abs(code), float2(1, 1));
  EXPECT_NEAR(OctahedralDecode(code), n, 1e-6);
}

[test]
[cases((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))]
void AxesComeBackExactly(float x, float y, float z) {
  EXPECT_EQ(OctahedralDecode(OctahedralEncode(float3(x, y, z))), float3(x, y, z));
}

// Stored in 8 bits, the largest step is 1/128.
[test] void ColorsAreFineInBytes() {
  float largest = 0;
  [loop] for (uint i = 0; i < 255; ++i) {
    largest = max(largest, DecodeColor(float(i + 1) / 255).x - DecodeColor(float(i) / 255).x);
  }
  EXPECT_NEAR(largest, 1.0 / 128, 1e-4);
  EXPECT_NEAR(DecodeColor(EncodeColor(float3(0, 0.18, 1))), float3(0, 0.18, 1), 1e-6);
}

// Through the channels of the picture: 8 bits for the code, half a float for the root.
void through_the_picture(float3 f0, float f90, out float3 f0_back, out float f90_back) {
  float tint;
  const float2 code = EncodeDielectric(f0, f90, tint);
  EXPECT_EQ(f16tof32(f32tof16(tint)), tint);
  const float4 material = float4(0, 0, round(code.x * 255) / 255, f16tof32(f32tof16(code.y)));
  DecodeDielectric(material, IsTinted(material) ? tint : kNoTint, f0_back, f90_back);
}

[test]
[cases((0.02, 1), (0.04, 0.5), (0.16, 0.25), (0, 0), (1, 1))]
void GraysComeBack(float f0, float f90) {
  float3 f0_back;
  float f90_back;
  through_the_picture(f0, f90, f0_back, f90_back);
  EXPECT_NEAR(f0_back, float3(f0, f0, f0), 1e-3);
  EXPECT_NEAR(f90_back, f90, 0.5 / 63 + 1e-6);
}

// Each component of a colour lies on a step of a 15th of the root of the largest.
[test]
[cases((0.16, 0.04, 0.01), (0, 0.08, 0.02), (0.05, 0, 0))]
void TintsComeBack(float r, float g, float b) {
  const float3 f0 = float3(r, g, b);
  const float largest = max(r, max(g, b));
  float3 f0_back;
  float f90_back;
  through_the_picture(f0, 1, f0_back, f90_back);
  EXPECT_NEAR(sqrt(f0_back), sqrt(f0), sqrt(largest) / 30 + 1e-4);
  EXPECT_EQ(f90_back, 1);
}

[test] void GlassHasACodeOfItsOwn() {
  float tint;
  const float2 code = EncodeDielectric(float3(0.04, 0.04, 0.04), 1, tint);
  EXPECT_TRUE(IsPlainDielectric(float4(0, 0, code)));
  EXPECT_FALSE(IsTinted(float4(0, 0, code)));
  EXPECT_FALSE(IsPlainDielectric(float4(0, 0, EncodeDielectric(float3(0.05, 0.05, 0.05), 1, tint))));
  EXPECT_FALSE(IsPlainDielectric(float4(0, 0, EncodeDielectric(float3(0.04, 0.04, 0.04), 0.9, tint))));
}
