// SPDX-License-Identifier: MIT
#include "kaamos/shader/intrinsics_geometry.h"

#include "runtime/shader/test_values.h"

namespace kaamos::shader {
namespace {

TEST(ShaderGeometryIntrinsics, DotLengthAndKin) {
  EXPECT_EQ(dot(float3{1, 2, 3}, float3{4, 5, 6}), 32.0f);
  EXPECT_EQ(dot(int2{kIntMax, 1}, int2{2, 5}), 3);
  EXPECT_EQ(dot(3.0f, 4.0f), 12.0f);
  EXPECT_EQ(to_float(dot(convert<half>(float2{1, 2}), convert<half>(float2{3, 4}))), 11.0f);
  EXPECT_EQ(length(float2{3, 4}), 5.0f);
  EXPECT_EQ(length(-3.0f), 3.0f);
  EXPECT_EQ(distance(float2{1, 1}, float2{4, 5}), 5.0f);
  expect_components(cross(float3{1, 0, 0}, float3{0, 1, 0}), {0, 0, 1});
  expect_components(cross(float3{2, 3, 4}, float3{5, 6, 7}), {-3, 6, -3});
  expect_components(normalize(float3{0, 0, -8}), {0, 0, -1});
  EXPECT_TRUE(std::isnan(normalize(float3{0, 0, 0})[1]));
  const float3 n = normalize(float3{1, 2, 3});
  for (int i = 0; i < 3; ++i) expect_near_ulps(n[i], (i + 1) / std::sqrt(14.0L), 2, "normalize");
}

TEST(ShaderGeometryIntrinsics, ReflectRefractFaceforward) {
  expect_components(reflect(float3{1, -1, 0}, float3{0, 1, 0}), {1, 1, 0});
  expect_components(refract(float3{0, -1, 0}, float3{0, 1, 0}, 1.5f), {0, -1, 0});
  const float3 grazing = normalize(float3{1, -0.1f, 0});
  expect_components(refract(grazing, float3{0, 1, 0}, 1.5f), {0, 0, 0});
  const float3 bent = refract(normalize(float3{1, -1, 0}), float3{0, 1, 0}, 1 / 1.5f);
  EXPECT_NEAR(bent[0], std::sqrt(0.5f) / 1.5f, 1e-6f);
  EXPECT_NEAR(length(bent), 1.0f, 1e-6f);
  expect_components(faceforward(float2{0, 1}, float2{0, -1}, float2{0, 1}), {0, 1});
  expect_components(faceforward(float2{0, 1}, float2{0, 1}, float2{0, 1}), {0, -1});
  expect_components(faceforward(float2{0, 1}, float2{1, 0}, float2{0, 1}), {0, -1});
}

TEST(ShaderGeometryIntrinsics, LitAndDst) {
  expect_components(lit(0.5f, 0.5f, 2.0f), {1, 0.5, 0.25, 1});
  expect_components(lit(-0.5f, 0.5f, 2.0f), {1, 0, 0, 1});
  expect_components(lit(0.5f, -0.5f, 2.0f), {1, 0.5, 0, 1});
  expect_components(dst(float4{9, 2, 3, 9}, float4{9, 5, 9, 7}), {1, 10, 3, 7});
}

TEST(ShaderGeometryIntrinsics, MulHasNineShapes) {
  const float2x3 m{1, 2, 3, 4, 5, 6};
  const float3x2 n{1, 2, 3, 4, 5, 6};
  EXPECT_EQ(mul(2.0f, 3.0f), 6.0f);
  expect_components(mul(2.0f, float2{1, 2}), {2, 4});
  expect_components(mul(2.0f, m), {2, 4, 6, 8, 10, 12});
  expect_components(mul(float2{1, 2}, 2.0f), {2, 4});
  EXPECT_EQ(mul(float2{1, 2}, float2{3, 4}), 11.0f);
  expect_components(mul(float2{1, 2}, m), {9, 12, 15});
  expect_components(mul(m, 2.0f), {2, 4, 6, 8, 10, 12});
  expect_components(mul(m, float3{1, 2, 3}), {14, 32});
  expect_components(mul(m, n), {22, 28, 49, 64});
  expect_components(mul(n, m), {9, 12, 15, 19, 26, 33, 29, 40, 51});
  const float4x4 a{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
  expect_components(mul(a, float4{1, 0, 0, 1}), {5, 13, 21, 29});
  expect_components(mul(float4{1, 0, 0, 1}, a), {14, 16, 18, 20});
  expect_components(mul(int2x2{1, 2, 3, 4}, int2{5, 6}), {17, 39});
}

TEST(ShaderGeometryIntrinsics, SumsRunInOrderWithoutContraction) {
  // 1 is lost against 2^24 when added from first to last, and would survive in any other order.
  EXPECT_EQ(dot(float3{0x1p24f, 1, -0x1p24f}, float3{1, 1, 1}), 0.0f);
  EXPECT_EQ(mul(float3{0x1p24f, 1, -0x1p24f}, float3x1{1, 1, 1})[0], 0.0f);
  const float x = 1.0f + 0x1p-12f;
  EXPECT_EQ(dot(float2{x, 1}, float2{x, -1}), x * x - 1.0f);
}

TEST(ShaderGeometryIntrinsics, TransposeAndDeterminant) {
  expect_components(transpose(float2x3{1, 2, 3, 4, 5, 6}), {1, 4, 2, 5, 3, 6});
  EXPECT_EQ(determinant(float1x1{7}), 7.0f);
  EXPECT_EQ(determinant(float2x2{1, 2, 3, 4}), -2.0f);
  EXPECT_EQ(determinant(float3x3{2, 0, 1, 1, 3, 2, 1, 1, 4}), 18.0f);
  EXPECT_EQ(determinant(float4x4{1, 2, 3, 4, 2, 1, 0, 3, 5, 6, 7, 1, 2, 4, 8, 3}), -74.0f);
  EXPECT_EQ(determinant(float4x4{0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}), -1.0f);
}

}  // namespace
}  // namespace kaamos::shader
