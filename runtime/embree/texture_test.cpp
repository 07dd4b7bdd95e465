// SPDX-License-Identifier: MIT
#include "runtime/embree/texture.h"

#include <gtest/gtest.h>

#include "runtime/embree/testing/harness.h"
#include "runtime/shader/texture/texel_access.h"

namespace kaamos::embree {
namespace {

using testing::Harness;

rtapi::TextureDesc desc_of(uint32_t width, uint32_t height, uint16_t slices, uint16_t mips,
                           rtapi::Format format) {
  rtapi::TextureDesc desc;
  desc.Width = width;
  desc.Height = height;
  desc.DepthOrArraySize = slices;
  desc.MipLevels = mips;
  desc.Format = format;
  return desc;
}

struct ViewOf {
  std::shared_ptr<runtime::BackendTexture> texture;
  shader::Descriptor descriptor;
};

ViewOf make(Harness& h, const rtapi::TextureDesc& desc, runtime::TextureViewDesc view) {
  auto texture = h.device().create_texture(desc);
  EXPECT_TRUE(texture.ok());
  view.format = desc.Format;
  auto address = h.device().create_texture_view(**texture, view);
  EXPECT_TRUE(address.ok());
  shader::Descriptor descriptor;
  descriptor.kind = shader::DescriptorKind::kTexture;
  descriptor.address = *address;
  descriptor.format = static_cast<uint32_t>(desc.Format);
  return {*texture, descriptor};
}

uint32_t load(const ViewOf& view, int32_t x, int32_t y, int32_t slice = 0, int32_t mip = 0) {
  const int32_t coordinates[4] = {x, y, slice, mip};
  return shader::load_texel(view.descriptor, coordinates).bits[0];
}

TEST(Texture, ACopyFillsTheRightSubresource) {
  Harness h;
  runtime::TextureViewDesc whole;
  whole.dimension = rtapi::SrvDimension::kTexture2DArray;
  whole.mip_count = 3;
  whole.slice_count = 2;
  const ViewOf view = make(h, desc_of(8, 4, 2, 3, rtapi::Format::kR32Uint), whole);
  const auto source = h.buffer(512);
  auto* words = reinterpret_cast<uint32_t*>(source->host());
  for (uint32_t i = 0; i < 128; ++i) words[i] = 100 + i;
  runtime::CopyTextureCommand copy;
  copy.source.buffer = source;
  copy.source.row_pitch = 256;
  copy.source.slice_pitch = 512;
  copy.dest.texture = view.texture;
  copy.dest.mip = 1;
  copy.dest.array_element = 1;
  copy.dest.origin[0] = 2;
  copy.extent[0] = 2;
  copy.extent[1] = 2;
  copy.extent[2] = 1;
  ASSERT_TRUE(h.execute(copy).ok());
  EXPECT_EQ(load(view, 2, 0, 1, 1), 100u);
  EXPECT_EQ(load(view, 3, 1, 1, 1), 100u + 64 + 1);
  EXPECT_EQ(load(view, 1, 0, 1, 1), 0u);
  EXPECT_EQ(load(view, 2, 0, 0, 1), 0u);
  EXPECT_EQ(load(view, 4, 0, 1, 1), 0u);  // out of bounds
  // And back into a buffer.
  runtime::CopyTextureCommand back;
  back.source = copy.dest;
  back.dest = copy.source;
  back.dest.buffer = h.buffer(512);
  back.dest.origin[0] = 5;
  std::copy(std::begin(copy.extent), std::end(copy.extent), back.extent);
  ASSERT_TRUE(h.execute(back).ok());
  EXPECT_EQ(reinterpret_cast<uint32_t*>(back.dest.buffer->host())[64 + 6], 165u);
}

// Long rows are not contiguous in memory.
TEST(Texture, LongRowsKeepTheirTexels) {
  constexpr uint32_t kWidth = 1024, kHeight = 3, kPitch = 4 * kWidth;
  Harness h;
  runtime::TextureViewDesc whole;
  whole.dimension = rtapi::SrvDimension::kTexture2DArray;
  whole.mip_count = 2;
  whole.slice_count = 2;
  whole.unordered_access = true;
  const ViewOf view = make(h, desc_of(kWidth, kHeight, 2, 2, rtapi::Format::kR32Uint), whole);
  const auto source = h.buffer(kPitch * kHeight);
  auto* words = reinterpret_cast<uint32_t*>(source->host());
  for (uint32_t i = 0; i < kWidth * kHeight; ++i) words[i] = i;
  runtime::CopyTextureCommand copy;
  copy.source.buffer = source;
  copy.source.row_pitch = kPitch;
  copy.source.slice_pitch = kPitch * kHeight;
  copy.dest.texture = view.texture;
  copy.dest.array_element = 1;
  copy.extent[0] = kWidth;
  copy.extent[1] = kHeight;
  copy.extent[2] = 1;
  ASSERT_TRUE(h.execute(copy).ok());
  for (int32_t y = 0; y < static_cast<int32_t>(kHeight); ++y) {
    for (const int32_t x : {0, 511, 1023}) {
      EXPECT_EQ(load(view, x, y, 1), static_cast<uint32_t>(y) * kWidth + static_cast<uint32_t>(x));
      EXPECT_EQ(load(view, x, y, 0), 0u);
    }
  }
  runtime::CopyTextureCommand back;
  back.source = copy.dest;
  back.dest = copy.source;
  back.dest.buffer = h.buffer(kPitch * kHeight);
  std::copy(std::begin(copy.extent), std::end(copy.extent), back.extent);
  ASSERT_TRUE(h.execute(back).ok());
  EXPECT_EQ(std::memcmp(back.dest.buffer->host(), source->host(), kPitch * kHeight), 0);
  runtime::ClearUavCommand clear;
  clear.view = view.descriptor;
  clear.values[0] = 9;
  ASSERT_TRUE(h.execute(clear).ok());
  EXPECT_EQ(load(view, 1023, 2, 1), 9u);
  EXPECT_EQ(load(view, 0, 0, 0), 9u);
}

TEST(Texture, AViewOfPartOfATextureCountsFromItsFirstMipAndSlice) {
  Harness h;
  runtime::TextureViewDesc all;
  all.dimension = rtapi::SrvDimension::kTexture2DArray;
  all.unordered_access = true;
  all.slice_count = 3;
  all.first_mip = 1;
  ViewOf view = make(h, desc_of(8, 8, 3, 2, rtapi::Format::kR32Uint), all);
  const int32_t last[4] = {3, 3, 2, 0};
  shader::store_texel(view.descriptor, last, {{77, 0, 0, 0}});
  runtime::TextureViewDesc part;
  part.dimension = rtapi::SrvDimension::kTexture2D;
  part.format = rtapi::Format::kR32Uint;
  part.first_mip = 1;
  part.first_slice = 2;
  view.descriptor.address = *h.device().create_texture_view(*view.texture, part);
  EXPECT_EQ(load(view, 3, 3), 77u);
  EXPECT_EQ(view.descriptor.address, *h.device().create_texture_view(*view.texture, part));
}

TEST(Texture, AVolumesUnorderedViewStartsAtItsFirstSlice) {
  Harness h;
  auto desc = desc_of(2, 2, 4, 1, rtapi::Format::kR32Float);
  desc.Dimension = rtapi::ResourceDimension::kTexture3D;
  runtime::TextureViewDesc some;
  some.dimension = rtapi::SrvDimension::kTexture3D;
  some.unordered_access = true;
  some.first_slice = 2;
  some.slice_count = 2;
  ViewOf view = make(h, desc, some);
  const int32_t first[4] = {1, 0, 0, 0};
  shader::store_texel(view.descriptor, first, {{5, 0, 0, 0}});
  some.unordered_access = false;
  some.first_slice = 0;
  some.slice_count = 4;
  some.format = desc.Format;
  view.descriptor.address = *h.device().create_texture_view(*view.texture, some);
  EXPECT_EQ(load(view, 1, 0, 2), 5u);
  EXPECT_EQ(load(view, 1, 0, 0), 0u);
}

TEST(Texture, AViewThatIsLeftOverReadsZero) {
  Harness h;
  ViewOf view = make(h, desc_of(4, 4, 1, 1, rtapi::Format::kR8G8B8A8Unorm), {});
  view.texture.reset();
  for (int i = 0; i < 100; ++i) make(h, desc_of(4, 4, 1, 1, rtapi::Format::kR8G8B8A8Unorm), {});
  EXPECT_EQ(load(view, 0, 0), 0u);
}

TEST(Texture, ClearWritesEveryElement) {
  Harness h;
  runtime::TextureViewDesc written;
  written.unordered_access = true;
  const ViewOf view = make(h, desc_of(5, 3, 1, 1, rtapi::Format::kR8G8B8A8Unorm), written);
  runtime::ClearUavCommand clear;
  clear.view = view.descriptor;
  clear.is_float = true;
  const float half = 0.5f;
  std::memcpy(&clear.values[0], &half, 4);
  ASSERT_TRUE(h.execute(clear).ok());
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      float value;
      const uint32_t bits = load(view, x, y);
      std::memcpy(&value, &bits, 4);
      EXPECT_NEAR(value, 0.5f, 0.003f);
    }
  }
  clear.is_float = false;
  clear.values[0] = 255;
  ASSERT_TRUE(h.execute(clear).ok());
  EXPECT_EQ(load(view, 4, 2), 0x3F800000u);

  const auto block = h.buffer(64);
  clear.view = {};
  clear.view.kind = shader::DescriptorKind::kRawBuffer;
  clear.view.address = block->address();
  clear.view.size_bytes = 60;
  clear.values[0] = 0xABCD;
  ASSERT_TRUE(h.execute(clear).ok());
  EXPECT_EQ(reinterpret_cast<uint32_t*>(block->host())[14], 0xABCDu);
  EXPECT_EQ(reinterpret_cast<uint32_t*>(block->host())[15], 0u);
}

TEST(Sampler, EqualOnesAreOne) {
  Harness h;
  rtapi::SamplerDesc desc;
  const auto a = *h.device().create_sampler(desc);
  EXPECT_EQ(a, *h.device().create_sampler(desc));
  desc.AddressU = rtapi::TextureAddressMode::kClamp;
  EXPECT_NE(a, *h.device().create_sampler(desc));
}

}  // namespace
}  // namespace kaamos::embree
