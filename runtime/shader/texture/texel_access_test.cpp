// SPDX-License-Identifier: MIT
#include "runtime/shader/texture/texel_access.h"

#include <gtest/gtest.h>

#include <limits>

#include "runtime/shader/texture/texture_test_support.h"

namespace kaamos::shader {
namespace {

// Every texel encodes its position.
Texel place_texel(uint32_t x, uint32_t y, uint32_t slice, uint32_t mip) {
  return float_texel(static_cast<float>(x + 1), static_cast<float>(y), static_cast<float>(slice),
                     static_cast<float>(mip));
}

void expect_place(const Texel& texel, float x, float y, float slice, float mip) {
  EXPECT_EQ(channel(texel, 0), x + 1);
  EXPECT_EQ(channel(texel, 1), y);
  EXPECT_EQ(channel(texel, 2), slice);
  EXPECT_EQ(channel(texel, 3), mip);
}

bool is_zero(const Texel& texel) {
  return (texel.bits[0] | texel.bits[1] | texel.bits[2] | texel.bits[3]) == 0;
}

TEST(TexelAccess, LoadsByCoordinatesOfTheDimension) {
  const auto load = [](const TestTexture& t, int32_t x, int32_t y, int32_t z, int32_t mip) {
    const int32_t at[4] = {x, y, z, mip};
    return load_texel(t.descriptor, at);
  };
  using D = TextureDimension;
  TestTexture flat(D::k2D, kFormatRgba32Float, 8, 4, 1, 3, place_texel);
  expect_place(load(flat, 7, 3, 0, 0), 7, 3, 0, 0);
  expect_place(load(flat, 3, 1, 0, 1), 3, 1, 0, 1);
  expect_place(load(flat, 1, 0, 0, 2), 1, 0, 0, 2);
  EXPECT_TRUE(is_zero(load(flat, 1, 1, 1, 0)));  // as if an array of one
  TestTexture layers(D::k2DArray, kFormatRgba32Float, 4, 4, 3, 2, place_texel);
  expect_place(load(layers, 1, 1, 2, 1), 1, 1, 2, 1);
  TestTexture line(D::k1DArray, kFormatRgba32Float, 4, 1, 3, 1, place_texel);
  expect_place(load(line, 3, 99, 2, 0), 3, 0, 2, 0);
  TestTexture volume(D::k3D, kFormatRgba32Float, 4, 4, 4, 2, place_texel);
  expect_place(load(volume, 1, 0, 3, 0), 1, 0, 3, 0);
  expect_place(load(volume, 1, 0, 1, 1), 1, 0, 1, 1);
  EXPECT_TRUE(is_zero(load(volume, 1, 0, 2, 1)));
}

TEST(TexelAccess, OutOfBoundsReadsZerosAndWritesNothing) {
  TestTexture t(TextureDimension::k2DArray, kFormatRgba32Float, 8, 4, 2, 2, place_texel);
  constexpr int32_t kMin = std::numeric_limits<int32_t>::min();
  constexpr int32_t kMax = std::numeric_limits<int32_t>::max();
  const std::vector<uint8_t> before = t.memory;
  const int32_t outside[][4] = {{8, 0, 0, 0},  {0, 4, 0, 0},    {0, 0, 2, 0},    {0, 0, 0, 2},
                                {-1, 0, 0, 0}, {0, -1, 0, 0},   {0, 0, -1, 0},   {0, 0, 0, -1},
                                {4, 0, 0, 1},  {kMin, 0, 0, 0}, {0, kMax, 0, 0}, {0, 0, 0, kMin}};
  for (const auto& at : outside) {
    EXPECT_TRUE(is_zero(load_texel(t.descriptor, at)));
    store_texel(t.descriptor, at, float_texel(99));
  }
  EXPECT_EQ(t.memory, before);
  EXPECT_TRUE(is_zero(load_texel(Descriptor{}, outside[0])));
  t.view.format = 71;
  const int32_t inside[4] = {};
  EXPECT_TRUE(is_zero(load_texel(t.descriptor, inside)));
  store_texel(t.descriptor, inside, float_texel(99));
  EXPECT_EQ(t.memory, before);
}

TEST(TexelAccess, StoresReadBackAndNeedAnUnorderedAccessView) {
  TestTexture t(TextureDimension::k2D, kFormatRgba8Unorm, 4, 4, 1, 1, place_texel);
  const int32_t at[4] = {2, 1, 0, 0};
  store_texel(t.descriptor, at, float_texel(0.2f, 0.4f, 0.6f, 2.0f));
  EXPECT_EQ(channel(load_texel(t.descriptor, at), 0), 51 / 255.0f);
  EXPECT_EQ(channel(load_texel(t.descriptor, at), 3), 1.0f);
  t.view.unordered_access = false;
  store_texel(t.descriptor, at, float_texel(1));
  EXPECT_EQ(channel(load_texel(t.descriptor, at), 0), 51 / 255.0f);
}

TEST(TexelAccess, ComponentMapping) {
  TestTexture t(TextureDimension::k2D, kFormatRgba32Float, 2, 2, 1, 1,
                [](auto...) { return float_texel(10, 20, 30, 40); });
  const uint8_t mapping[4] = {2, 4, 5, 0};
  std::copy(mapping, mapping + 4, t.view.swizzle);
  const int32_t at[4] = {};
  const Texel texel = load_texel(t.descriptor, at);
  EXPECT_EQ(channel(texel, 0), 30.0f);
  EXPECT_EQ(channel(texel, 1), 0.0f);
  EXPECT_EQ(channel(texel, 2), 1.0f);
  EXPECT_EQ(channel(texel, 3), 10.0f);
  TestTexture u(TextureDimension::k2D, kFormatR32Uint, 1, 1, 1, 1, [](auto...) {
    return Texel{{7, 0, 0, 0}};
  });
  u.view.swizzle[1] = 5;
  EXPECT_EQ(load_texel(u.descriptor, at).bits[1], 1u);
}

TEST(TexelAccess, AddressesOfR32Only) {
  TestTexture u(TextureDimension::k2D, kFormatR32Uint, 4, 4, 1, 1,
                [](uint32_t x, uint32_t y, auto...) {
                  return Texel{{x + y * 10, 0, 0, 0}};
                });
  const int32_t at[4] = {3, 2, 0, 0}, outside[4] = {4, 0, 0, 0};
  ASSERT_NE(texel_address(u.descriptor, at, 4), nullptr);
  EXPECT_EQ(*static_cast<uint32_t*>(texel_address(u.descriptor, at, 4)), 23u);
  EXPECT_EQ(texel_address(u.descriptor, outside, 4), nullptr);
  u.view.unordered_access = false;
  EXPECT_EQ(texel_address(u.descriptor, at, 4), nullptr);
  TestTexture c(TextureDimension::k2D, kFormatRgba8Unorm, 4, 4, 1, 1, place_texel);
  EXPECT_EQ(texel_address(c.descriptor, at, 4), nullptr);
}

TEST(TexelAccess, TypedBuffers) {
  uint32_t data[8] = {0x04030201u, 0x08070605u, 99, 99, 99, 99, 99, 99};
  Descriptor buffer;
  buffer.kind = DescriptorKind::kTypedBuffer;
  buffer.access = DescriptorAccess::kUnorderedAccess;
  buffer.format = 30;  // R8G8B8A8_UINT
  buffer.address = reinterpret_cast<uintptr_t>(data);
  buffer.size_bytes = 8;
  EXPECT_EQ(load_typed(buffer, 1).bits[2], 7u);
  EXPECT_TRUE(is_zero(load_typed(buffer, 2)));
  EXPECT_TRUE(is_zero(load_typed(buffer, 0xFFFFFFFFu)));
  store_typed(buffer, 1, {{1, 2, 3, 400}});
  EXPECT_EQ(data[1], 0xFF030201u);
  store_typed(buffer, 2, {{1, 2, 3, 4}});
  EXPECT_EQ(data[2], 99u);
  EXPECT_EQ(typed_address(buffer, 0, 4), nullptr);
  buffer.format = kFormatR32Uint;
  EXPECT_EQ(typed_address(buffer, 1, 4), data + 1);
  EXPECT_EQ(typed_address(buffer, 2, 4), nullptr);
  EXPECT_EQ(texture_dimensions(buffer, 0).width, 2u);
  buffer.access = DescriptorAccess::kShaderResource;
  EXPECT_EQ(typed_address(buffer, 1, 4), nullptr);
  store_typed(buffer, 0, {{5, 0, 0, 0}});
  EXPECT_EQ(data[0], 0x04030201u);
  buffer.format = 0;
  EXPECT_TRUE(is_zero(load_typed(buffer, 0)));
  EXPECT_EQ(texture_dimensions(buffer, 0).width, 0u);
  buffer.format = kFormatR32Uint;
  buffer.size_bytes = 3;
  EXPECT_TRUE(is_zero(load_typed(buffer, 0)));
}

TEST(TexelAccess, Dimensions) {
  TestTexture cubes(TextureDimension::kCubeArray, kFormatRgba8Unorm, 8, 8, 12, 3, place_texel);
  const TextureDimensions d = texture_dimensions(cubes.descriptor, 1);
  EXPECT_EQ(d.width, 4u);
  EXPECT_EQ(d.height, 4u);
  EXPECT_EQ(d.depth_or_elements, 2u);
  EXPECT_EQ(d.mip_count, 3u);
  EXPECT_EQ(texture_dimensions(cubes.descriptor, 3).width, 0u);
  EXPECT_EQ(texture_dimensions(cubes.descriptor, 3).mip_count, 3u);
  TestTexture volume(TextureDimension::k3D, kFormatRgba8Unorm, 8, 4, 4, 2, place_texel);
  EXPECT_EQ(texture_dimensions(volume.descriptor, 1).depth_or_elements, 2u);
  EXPECT_EQ(texture_dimensions(Descriptor{}, 0).mip_count, 0u);
}

}  // namespace
}  // namespace kaamos::shader
