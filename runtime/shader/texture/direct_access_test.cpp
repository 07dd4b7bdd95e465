// SPDX-License-Identifier: MIT
//
// Texels that emitted code reads and writes in place match what the services would give.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "kaamos/shader/prelude.h"
#include "runtime/shader/texture/texture_test_support.h"

namespace kaamos::shader {
namespace {

constexpr int32_t kWidth = 4, kHeight = 3;

struct Access {
  Services services;
  DispatchConstants dispatch;
  Invocation invocation;

  Access() {
    set_texture_services(services);
    dispatch.services = &services;
    dispatch.direct_texels = true;
    invocation.dispatch = &dispatch;
  }
};

struct RandomTexture : TestTexture {
  RandomTexture(uint32_t format, bool direct)
      : TestTexture(TextureDimension::k2D, format, kWidth, kHeight, 1, 1,
                    [](uint32_t, uint32_t, uint32_t, uint32_t) { return Texel{}; }) {
    std::mt19937 random(format);
    for (uint8_t& byte : memory) byte = static_cast<uint8_t>(random());
    view.direct_format = direct ? format : 0;
  }
};

float value_of(std::mt19937& random) {
  const float special[] = {0.0f,
                           -0.0f,
                           1.0f,
                           -1.0f,
                           2.5f,
                           -7.0f,
                           1e-9f,
                           70000.0f,
                           std::numeric_limits<float>::infinity(),
                           -std::numeric_limits<float>::infinity(),
                           std::numeric_limits<float>::quiet_NaN()};
  std::uniform_real_distribution<float> uniform(-1.2f, 1.2f);
  return random() % 3 == 0 ? special[random() % std::size(special)] : uniform(random);
}

// Compares bits, so that NaNs can be compared.
template <class V>
bool same(const V& a, const V& b) {
  return std::memcmp(&a, &b, sizeof(V)) == 0;
}

template <class V>
void expect_same(uint32_t format) {
  Access access;
  RandomTexture direct(format, true);
  RandomTexture called(format, false);
  BoundResource bound;
  bound.descriptor = direct.descriptor;
  bound.direct_format = format;
  bound.width = kWidth;
  bound.height = kHeight;
  bound.row_pitch = direct.view.mips[0].row_pitch;
  bound.texels = direct.view.mips[0].texels;
  bound.writable = true;
  std::mt19937 random(7);
  for (int32_t y = -1; y <= kHeight; ++y) {
    for (int32_t x = -1; x <= kWidth; ++x) {
      const int4 at = {{x, y, 0, 0}};
      const V expected = load_texel<V>(access.invocation, called.descriptor, at);
      EXPECT_TRUE(same(load_texel<V>(access.invocation, direct.descriptor, at), expected))
          << format << " at " << x << "," << y;
      EXPECT_TRUE(same(load_texel<V>(access.invocation, bound, at), expected)) << format;
      V value{};
      for (int i = 0; i < shape<V>::count; ++i) {
        const float x_i = value_of(random);
        if constexpr (is_float<scalar_of<V>>) {
          component(value, i) = x_i;
        } else {
          component(value, i) = static_cast<scalar_of<V>>(random());
        }
      }
      store_texel(access.invocation, called.descriptor, at, value);
      if (x % 2 == 0) {
        store_texel(access.invocation, direct.descriptor, at, value);
      } else {
        store_texel(access.invocation, bound, at, value);
      }
      EXPECT_EQ(direct.memory, called.memory) << format << " at " << x << "," << y;
    }
  }
  // Neither writes through a read-only view.
  const std::vector<uint8_t> before = direct.memory;
  direct.view.unordered_access = bound.writable = false;
  store_texel(access.invocation, direct.descriptor, int4{{1, 1, 0, 0}}, V{});
  store_texel(access.invocation, bound, int4{{1, 1, 0, 0}}, V{});
  EXPECT_EQ(direct.memory, before);
}

TEST(DirectAccess, DimensionsAreThoseOfTheServices) {
  Access access;
  RandomTexture texture(2, true);
  TextureView& view = texture.view;
  view.mip_count = 3;
  view.slice_count = 6;
  for (uint32_t mip = 0; mip < kMaxTextureMips; ++mip) {
    view.mips[mip].width = 40 >> mip;
    view.mips[mip].height = 24 >> mip;
    view.mips[mip].depth = 5;
  }
  for (const TextureDimension dimension :
       {TextureDimension::k2D, TextureDimension::k2DArray, TextureDimension::k3D,
        TextureDimension::kCube, TextureDimension::kCubeArray, TextureDimension::k1D}) {
    view.dimension = dimension;
    for (const uint32_t mip : {0u, 2u, 3u, 0xFFFFFFFFu}) {
      access.dispatch.direct_texels = true;
      const uint4 direct = dimensions(access.invocation, texture.descriptor, mip);
      access.dispatch.direct_texels = false;
      EXPECT_TRUE(same(direct, dimensions(access.invocation, texture.descriptor, mip)))
          << static_cast<uint32_t>(dimension) << ", mip " << mip;
    }
  }
  view.dimension = TextureDimension::k2D;
  access.dispatch.direct_texels = true;
  const uint4 first = dimensions(access.invocation, texture.descriptor, 0);
  EXPECT_TRUE(same(first, uint4{{40, 24, 6, 3}}));
}

TEST(DirectAccess, GivesWhatTheServicesGive) {
  expect_same<float>(41);
  expect_same<vec<float, 2>>(16);
  expect_same<vec<float, 3>>(6);
  expect_same<vec<float, 4>>(2);
  expect_same<uint32_t>(42);
  expect_same<vec<uint32_t, 2>>(17);
  expect_same<vec<uint32_t, 4>>(3);
  expect_same<int32_t>(43);
  expect_same<vec<int32_t, 2>>(18);
  expect_same<vec<int32_t, 4>>(4);
}

TEST(DirectAccess, ConvertsAsTheServicesDo) {
  expect_same<vec<float, 2>>(37);
  expect_same<vec<float, 4>>(28);
  expect_same<vec<float, 4>>(10);
  // Formats that are not read in place, and a different number of channels.
  expect_same<vec<float, 4>>(11);
  expect_same<vec<float, 4>>(37);
  expect_same<float>(28);
}

}  // namespace
}  // namespace kaamos::shader
