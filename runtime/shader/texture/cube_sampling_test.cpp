// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/shader/texture/cube_face.h"
#include "runtime/shader/texture/texture_test_support.h"

namespace kaamos::shader {
namespace {

using D = TextureDimension;
constexpr uint32_t kPoint = 0, kBilinear = 0x14;

// u points right and v down on each face, as in D3D's cube map table.
TEST(CubeSampling, FacesLieAsInD3D) {
  struct Case {
    double direction[3];
    uint32_t face;
    double u, v;
  };
  const Case cases[] = {
      {{1, 0, 0}, 0, 0.5, 0.5},       {{1, 0.5, 0}, 0, 0.5, 0.25},   {{1, 0, -0.5}, 0, 0.75, 0.5},
      {{-1, 0, 0}, 1, 0.5, 0.5},      {{-1, 0.5, 0}, 1, 0.5, 0.25},  {{-1, 0, 0.5}, 1, 0.75, 0.5},
      {{0, 1, 0}, 2, 0.5, 0.5},       {{0.5, 1, 0}, 2, 0.75, 0.5},   {{0, 1, 0.5}, 2, 0.5, 0.75},
      {{0, -1, 0}, 3, 0.5, 0.5},      {{0.5, -1, 0}, 3, 0.75, 0.5},  {{0, -1, -0.5}, 3, 0.5, 0.75},
      {{0, 0, 1}, 4, 0.5, 0.5},       {{0.5, 0, 1}, 4, 0.75, 0.5},   {{0, 0.5, 1}, 4, 0.5, 0.25},
      {{0, 0, -1}, 5, 0.5, 0.5},      {{-0.5, 0, -1}, 5, 0.75, 0.5}, {{0, 0.5, -1}, 5, 0.5, 0.25},
      {{0, 0, 0}, 4, 0.5, 0.5},       {{1, 1, 1}, 4, 1.0, 0.0},      {{-2, 1, 0}, 1, 0.5, 0.25},
      {{NAN, NAN, NAN}, 0, 0.5, 0.5},
  };
  for (const Case& c : cases) {
    const CubePlace place = cube_place(c.direction);
    EXPECT_EQ(place.face, c.face) << c.direction[0] << c.direction[1] << c.direction[2];
    EXPECT_EQ(place.u, c.u);
    EXPECT_EQ(place.v, c.v);
  }
}

TEST(CubeSampling, DirectionsInvertPlaces) {
  for (uint32_t face = 0; face < 6; ++face) {
    for (const double u : {0.1, 0.5, 0.8}) {
      for (const double v : {0.2, 0.5, 0.9}) {
        double d[3];
        cube_direction({face, u, v}, d);
        const CubePlace back = cube_place(d);
        EXPECT_EQ(back.face, face);
        EXPECT_NEAR(back.u, u, 1e-12);
        EXPECT_NEAR(back.v, v, 1e-12);
      }
    }
  }
}

// One texel past an edge is the neighbour's outermost texel, at the same place along the edge.
TEST(CubeSampling, NeighboursMeetTexelByTexel) {
  for (const int size : {1, 2, 7, 256, 16384}) {
    for (uint32_t face = 0; face < 6; ++face) {
      for (int step = 0; step <= 8; ++step) {
        const int along = std::min(step * size / 8, size - 1);
        const int past[4][2] = {{-1, along}, {size, along}, {along, -1}, {along, size}};
        for (const auto& p : past) {
          double d[3];
          cube_direction({face, (p[0] + 0.5) / size, (p[1] + 0.5) / size}, d);
          const CubePlace place = cube_place(d);
          EXPECT_NE(place.face, face);
          const int x = std::min(static_cast<int>(place.u * size), size - 1);
          const int y = std::min(static_cast<int>(place.v * size), size - 1);
          EXPECT_TRUE(x == 0 || y == 0 || x == size - 1 || y == size - 1)
              << size << " " << x << " " << y;
          // And back: the neighbour's texel, moved over the edge, ends on this face's edge.
          const auto is_along = [&](int i) { return i == along || i == size - 1 - along; };
          EXPECT_TRUE(is_along(x) || is_along(y)) << size << " " << x << " " << y;
        }
      }
    }
  }
}

Texel face_number(uint32_t, uint32_t, uint32_t slice, uint32_t) {
  return float_texel(static_cast<float>(slice), static_cast<float>(slice % 6 == 0 ? 1 : 0));
}

TEST(CubeSampling, PointReadsTheFaceOfTheDirection) {
  TestTexture cubes(D::kCubeArray, kFormatRgba32Float, 4, 4, 12, 2, face_number);
  TestSampler sampler(kPoint);
  const float axes[6][3] = {{2, 0, 0}, {-2, 0, 0}, {0, 0.1f, 0}, {0, -9, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int face = 0; face < 6; ++face) {
    for (int cube = 0; cube < 2; ++cube) {
      const float* d = axes[face];
      const SampleArguments a =
          sample_arguments(cubes, sampler, d[0], d[1], d[2], static_cast<float>(cube));
      EXPECT_EQ(channel(sample_level(a), 0), static_cast<float>(face + 6 * cube));
    }
  }
}

TEST(CubeSampling, EdgesAndCornersBlendAllFacesThatMeet) {
  TestTexture cube(D::kCube, kFormatRgba32Float, 4, 4, 6, 1, face_number);
  TestSampler sampler(kBilinear);
  const auto sample = [&](float x, float y, float z) {
    return channel(sample_level(sample_arguments(cube, sampler, x, y, z)), 0);
  };
  EXPECT_NEAR(sample(1, 0, 1), (0 + 4) / 2.0f, 1e-6f);
  EXPECT_NEAR(sample(-1, 1, 0), (1 + 2) / 2.0f, 1e-6f);
  EXPECT_NEAR(sample(0, -1, -1), (3 + 5) / 2.0f, 1e-6f);
  EXPECT_NEAR(sample(1, 1, 1), (0 + 2 + 4) / 3.0f, 1e-6f);
  EXPECT_NEAR(sample(-1, -1, -1), (1 + 3 + 5) / 3.0f, 1e-6f);
  EXPECT_EQ(sample(1, 0.5f, 0), 0.0f);
}

// A smooth function of direction, stored in the texels, must be sampled smoothly everywhere.
TEST(CubeSampling, NoSeams) {
  constexpr uint32_t kSize = 16;
  TestTexture cube(D::kCube, kFormatRgba32Float, kSize, kSize, 6, 1,
                   [](uint32_t x, uint32_t y, uint32_t slice, uint32_t) {
                     double d[3];
                     cube_direction({slice, (x + 0.5) / kSize, (y + 0.5) / kSize}, d);
                     const double n = std::hypot(d[0], d[1], d[2]);
                     return float_texel(float(d[0] / n), float(d[1] / n), float(d[2] / n));
                   });
  TestSampler sampler(kBilinear);
  for (int i = 0; i < 400; ++i) {
    const float a = static_cast<float>(i) * 0.0157f, b = static_cast<float>(i) * 0.113f;
    const float d[3] = {std::cos(a) * std::sin(b), std::sin(a) * std::sin(b), std::cos(b)};
    const Texel texel = sample_level(sample_arguments(cube, sampler, d[0], d[1], d[2]));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(channel(texel, c), d[c], 0.03f);
  }
}

TEST(CubeSampling, GradientsScaleWithTheFace) {
  TestTexture cube(D::kCube, kFormatRgba32Float, 64, 64, 6, 7,
                   [](uint32_t, uint32_t, uint32_t, uint32_t mip) {
                     return float_texel(static_cast<float>(mip));
                   });
  TestSampler sampler(0x15);
  // u spans 2 units of z at x = 1, which is 64 texels. A step of 4 texels is 8 / 64 of z there.
  for (const float scale : {1.0f, 3.0f}) {
    SampleArguments a = sample_arguments(cube, sampler, scale, 0.1f * scale, 0.2f * scale);
    a.ddx[2] = scale * 8 / 64.0f;
    EXPECT_NEAR(channel(sample_gradient(a), 0), 2.0f, 1e-5f);
  }
  // Along the direction itself nothing changes.
  SampleArguments a = sample_arguments(cube, sampler, -1, 0.5f, 0.25f);
  a.ddx[0] = -1, a.ddx[1] = 0.5f, a.ddx[2] = 0.25f;
  EXPECT_EQ(channel(sample_gradient(a), 0), 0.0f);
}

TEST(CubeSampling, IncompleteCubesAndCrookedFacesReadZeros) {
  TestTexture cube(D::kCube, kFormatRgba32Float, 4, 4, 6, 1,
                   [](auto...) { return float_texel(1); });
  TestSampler sampler(kBilinear);
  const SampleArguments a = sample_arguments(cube, sampler, 1, 1, 1);
  EXPECT_EQ(channel(sample_level(a), 0), 1.0f);
  cube.view.slice_count = 5;
  EXPECT_EQ(channel(sample_level(a), 0), 0.0f);
  cube.view.slice_count = 6;
  cube.view.mips[0].height = 3;
  EXPECT_EQ(channel(sample_level(a), 0), 0.0f);
}

}  // namespace
}  // namespace kaamos::shader
