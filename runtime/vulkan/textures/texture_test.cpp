// SPDX-License-Identifier: MIT
#include "runtime/vulkan/textures/texture.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <random>

#include "runtime/shader/texture/format_codec.h"
#include "runtime/vulkan/memory/memory.h"
#include "runtime/vulkan/testing/texel_kernel.h"
#include "runtime/vulkan/testing/vulkan_device.h"

namespace kaamos::vulkan {
namespace {

using rtapi::Format;
using shader::NumberClass;
using testing::TexelKernel;

struct Harness {
  explicit Harness(std::shared_ptr<Gpu> made) : gpu(std::move(made)), stream(gpu) {
    descriptors = *DescriptorSet::create(gpu);
    textures = *TextureStore::create(gpu, descriptors);
  }
  std::shared_ptr<runtime::BackendBuffer> buffer(uint64_t bytes) {
    rtapi::BufferDesc desc;
    desc.SizeInBytes = bytes;
    return *memory->create_buffer(*gpu, desc, memory);
  }
  rtapi::Status copy(const runtime::CopyTextureCommand& command) {
    return textures->copy(stream, command);
  }

  std::shared_ptr<Gpu> gpu;
  std::shared_ptr<Memory> memory = std::make_shared<Memory>();
  std::shared_ptr<DescriptorSet> descriptors;
  std::unique_ptr<TextureStore> textures;
  CommandStream stream;
};

rtapi::TextureDesc desc_of(uint32_t width, uint32_t height, uint16_t slices, uint16_t mips,
                           Format format) {
  rtapi::TextureDesc desc;
  desc.Width = width;
  desc.Height = height;
  desc.DepthOrArraySize = slices;
  desc.MipLevels = mips;
  desc.Format = format;
  return desc;
}

// Those of colours: depth and stencil come with depth buffers.
std::vector<Format> formats() {
  std::vector<Format> result;
  for (uint32_t i = 1; i < 120; ++i) {
    const auto format = static_cast<Format>(i);
    const bool of_depth =
        format == Format::kR32FloatX8X24Typeless || format == Format::kX32TypelessG8X24Uint ||
        format == Format::kR24UnormX8Typeless || format == Format::kX24TypelessG8Uint;
    if (!of_depth && shader::format_codec(i).bytes != 0 &&
        rtapi::GetFormatInfo(format).bytes != 0) {
      result.push_back(format);
    }
  }
  return result;
}

constexpr uint32_t kSide = 8;
// Lavapipe's polynomial for sRGB is off by up to 0.0012.
constexpr float kSrgbTolerance = 1.5e-3f;

// Fills one texel with a valid number in each channel, so that no NaN is among them.
void fill_texel(const shader::FormatCodec& codec, std::mt19937& random, uint8_t* element) {
  if (codec.encode == nullptr) {
    for (uint32_t i = 0; i < codec.bytes; ++i) element[i] = static_cast<uint8_t>(random());
    return;
  }
  shader::Texel texel;
  for (uint32_t& bits : texel.bits) {
    bits = codec.number == NumberClass::kFloat
               ? std::bit_cast<uint32_t>(static_cast<float>(random() % 4001) / 2000.0f - 1)
               : random() % 100;
  }
  codec.encode(element, texel);
}

runtime::CopyTextureCommand upload_of(std::shared_ptr<runtime::BackendTexture> texture,
                                      std::shared_ptr<runtime::BackendBuffer> buffer,
                                      uint32_t width, uint32_t height) {
  runtime::CopyTextureCommand copy;
  copy.dest.texture = std::move(texture);
  copy.source.buffer = std::move(buffer);
  copy.source.row_pitch = 256;
  copy.source.slice_pitch = uint64_t{256} * height;
  copy.extent[0] = width;
  copy.extent[1] = height;
  copy.extent[2] = 1;
  return copy;
}

TEST(VulkanTexture, EveryFormatIsReadAndWrittenAsTheCodecsSay) {
  KAAMOS_NEED_GPU(gpu);
  Harness h(gpu);
  TexelKernel kernel(gpu, *h.descriptors);
  std::mt19937 random(1);
  for (const Format format : formats()) {
    SCOPED_TRACE(static_cast<uint32_t>(format));
    const shader::FormatCodec& codec = shader::format_codec(static_cast<uint32_t>(format));
    auto texture = h.textures->create_texture(desc_of(kSide, kSide, 1, 1, format));
    if (!texture && !gpu->is_lavapipe()) continue;
    ASSERT_TRUE(texture) << texture.error().message;
    const auto source = h.buffer(256 * kSide);
    std::vector<shader::Texel> expected;
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
      uint8_t* at = source->host() + i / kSide * 256 + i % kSide * codec.bytes;
      fill_texel(codec, random, at);
      expected.push_back(codec.decode(at));
    }
    const auto upload = upload_of(*texture, source, kSide, kSide);
    ASSERT_TRUE(h.copy(upload));
    runtime::CopyTextureCommand download;
    download.source = upload.dest;
    download.dest = upload.source;
    download.dest.buffer = h.buffer(256 * kSide);
    std::copy_n(upload.extent, 3, download.extent);
    ASSERT_TRUE(h.copy(download));
    ASSERT_TRUE(h.stream.flush());
    EXPECT_EQ(std::memcmp(source->host(), download.dest.buffer->host(), 256 * kSide), 0);

    runtime::TextureViewDesc view;
    view.format = format;
    const auto index = h.textures->create_view(**texture, view);
    ASSERT_TRUE(index) << index.error().message;
    const bool srgb = rtapi::GetFormatInfo(format).srgb;
    const auto read = kernel.read(*index, codec.number, kSide, kSide);
    for (size_t i = 0; i < expected.size(); ++i) {
      for (int c = 0; c < 4; ++c) {
        if (codec.number != NumberClass::kFloat) {
          ASSERT_EQ(read[i].bits[c], expected[i].bits[c]) << i << " " << c;
          continue;
        }
        const float value = std::bit_cast<float>(expected[i].bits[c]);
        ASSERT_NEAR(std::bit_cast<float>(read[i].bits[c]), value,
                    srgb ? kSrgbTolerance : 2e-6f * std::fabs(value))
            << i << " " << c;
      }
    }
  }
}

TEST(VulkanTexture, EveryWritableFormatIsStoredAndCleared) {
  KAAMOS_NEED_GPU(gpu);
  Harness h(gpu);
  TexelKernel kernel(gpu, *h.descriptors);
  for (const Format format : formats()) {
    SCOPED_TRACE(static_cast<uint32_t>(format));
    const shader::FormatCodec& codec = shader::format_codec(static_cast<uint32_t>(format));
    auto desc = desc_of(kSide, kSide, 1, 1, format);
    desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
    auto texture = h.textures->create_texture(desc);
    if (!texture) {
      // Formats without unordered access, and 96-bit and alpha-only ones.
      EXPECT_EQ(texture.error().id.text(), "KA0960");
      continue;
    }
    ASSERT_NE(codec.encode, nullptr);
    runtime::TextureViewDesc view;
    view.format = format;
    view.unordered_access = true;
    const auto index = h.textures->create_view(**texture, view);
    ASSERT_TRUE(index) << index.error().message;
    shader::Texel value = {{3, 77, 120, 1}};
    if (codec.number == NumberClass::kFloat) {
      for (int c = 0; c < 4; ++c) value.bits[c] = std::bit_cast<uint32_t>(0.25f * (c + 1));
    }
    uint8_t element[16] = {};
    codec.encode(element, value);
    runtime::CopyTextureCommand download;
    download.source.texture = *texture;
    download.dest.buffer = h.buffer(256 * kSide);
    download.dest.row_pitch = 256;
    download.dest.slice_pitch = 256 * kSide;
    download.extent[0] = download.extent[1] = kSide;
    download.extent[2] = 1;
    const auto expect_everywhere = [&](const char* what) {
      ASSERT_TRUE(h.copy(download));
      ASSERT_TRUE(h.stream.flush());
      for (uint32_t i = 0; i < kSide * kSide; ++i) {
        const uint8_t* at =
            download.dest.buffer->host() + i / kSide * 256 + i % kSide * codec.bytes;
        ASSERT_EQ(std::memcmp(at, element, codec.bytes), 0) << what << " " << i;
      }
    };
    kernel.write(*index, codec.number, kSide, kSide, value);
    if (format != Format::kB8G8R8X8Unorm) expect_everywhere("stored");
    runtime::ClearUavCommand clear;
    clear.view.kind = shader::DescriptorKind::kTexture;
    clear.view.access = shader::DescriptorAccess::kUnorderedAccess;
    clear.view.address = *index;
    clear.view.format = static_cast<uint32_t>(format);
    clear.resource = std::shared_ptr<runtime::BackendTexture>(*texture);
    clear.is_float = codec.number == NumberClass::kFloat;
    for (int c = 0; c < 4; ++c) {
      // Two bits of alpha hold no more than 3: clears keep the low bits, stores the nearest value.
      value.bits[c] = clear.is_float ? std::bit_cast<uint32_t>(0.5f) : 1u + c % 3u;
      clear.values[c] = value.bits[c];
    }
    codec.encode(element, value);
    ASSERT_TRUE(h.textures->clear(h.stream, clear));
    expect_everywhere("cleared");
  }
}

TEST(VulkanTexture, NewTexturesAreZero) {
  KAAMOS_NEED_GPU(gpu);
  Harness h(gpu);
  TexelKernel kernel(gpu, *h.descriptors);
  for (int i = 0; i < 3; ++i) {
    auto texture = *h.textures->create_texture(desc_of(64, 64, 1, 1, Format::kR32Uint));
    runtime::TextureViewDesc view;
    view.format = Format::kR32Uint;
    const auto texels =
        kernel.read(*h.textures->create_view(*texture, view), NumberClass::kUint, 64, 64);
    for (const auto& texel : texels) ASSERT_EQ(texel.bits[0], 0u);
    auto rubbish = h.buffer(256 * 64);
    std::memset(rubbish->host(), 0xEE, 256 * 64);
    ASSERT_TRUE(h.copy(upload_of(texture, rubbish, 64, 64)));
    ASSERT_TRUE(h.stream.flush());
  }
}

TEST(VulkanTexture, ACopyFillsTheRightSubresource) {
  KAAMOS_NEED_GPU(gpu);
  Harness h(gpu);
  TexelKernel kernel(gpu, *h.descriptors);
  auto texture = *h.textures->create_texture(desc_of(16, 8, 2, 3, Format::kR32Uint));
  const auto source = h.buffer(512);
  auto* words = reinterpret_cast<uint32_t*>(source->host());
  for (uint32_t i = 0; i < 128; ++i) words[i] = 100 + i;
  auto copy = upload_of(texture, source, 2, 2);
  copy.dest.mip = 1;
  copy.dest.array_element = 1;
  copy.dest.origin[0] = 2;
  copy.source.origin[0] = 1;
  ASSERT_TRUE(h.copy(copy));
  // From there to a one-dimensional texture.
  auto line_desc = desc_of(8, 1, 1, 1, Format::kR32Uint);
  line_desc.Dimension = rtapi::ResourceDimension::kTexture1D;
  auto line = *h.textures->create_texture(line_desc);
  runtime::CopyTextureCommand across;
  across.source = copy.dest;
  across.source.origin[1] = 1;
  across.dest.texture = line;
  across.dest.origin[0] = 5;
  across.extent[0] = 2;
  across.extent[1] = across.extent[2] = 1;
  ASSERT_TRUE(h.copy(across));
  runtime::CopyTextureCommand back;
  back.source.texture = line;
  back.dest.buffer = h.buffer(512);
  back.dest.row_pitch = 256;
  back.dest.slice_pitch = 256;
  back.extent[0] = 8;
  back.extent[1] = back.extent[2] = 1;
  ASSERT_TRUE(h.copy(back));
  ASSERT_TRUE(h.stream.flush());
  const auto* out = reinterpret_cast<const uint32_t*>(back.dest.buffer->host());
  EXPECT_EQ(out[4], 0u);
  EXPECT_EQ(out[5], 100u + 64 + 1);
  EXPECT_EQ(out[6], 100u + 64 + 2);
  runtime::TextureViewDesc view;
  view.format = Format::kR32Uint;
  view.first_mip = 1;
  view.first_slice = 1;
  const auto texels =
      kernel.read(*h.textures->create_view(*texture, view), NumberClass::kUint, 8, 4);
  EXPECT_EQ(texels[1].bits[0], 0u);
  EXPECT_EQ(texels[2].bits[0], 101u);
  EXPECT_EQ(texels[3].bits[0], 102u);
  EXPECT_EQ(texels[8 + 3].bits[0], 100u + 64 + 2);
}

TEST(VulkanTexture, RowsThatVulkanCannotDescribeAreCopiedOneByOne) {
  KAAMOS_NEED_GPU(gpu);
  Harness h(gpu);
  auto desc = desc_of(5, 4, 3, 1, Format::kR32G32B32Float);
  desc.Dimension = rtapi::ResourceDimension::kTexture3D;
  auto texture = h.textures->create_texture(desc);
  if (!texture) GTEST_SKIP() << texture.error().message;
  // 256 bytes are not a whole number of 12-byte texels.
  const auto source = h.buffer(256 * 12);
  for (uint32_t i = 0; i < 256 * 12; ++i) source->host()[i] = static_cast<uint8_t>(i * 7 % 61);
  auto copy = upload_of(*texture, source, 5, 4);
  copy.extent[2] = 3;
  ASSERT_TRUE(h.copy(copy));
  runtime::CopyTextureCommand back;
  back.source = copy.dest;
  back.dest = copy.source;
  back.dest.buffer = h.buffer(256 * 12);
  std::copy_n(copy.extent, 3, back.extent);
  ASSERT_TRUE(h.copy(back));
  ASSERT_TRUE(h.stream.flush());
  for (uint32_t row = 0; row < 12; ++row) {
    EXPECT_EQ(std::memcmp(source->host() + 256 * row, back.dest.buffer->host() + 256 * row, 60), 0);
    EXPECT_EQ(back.dest.buffer->host()[256 * row + 60], 0);
  }
}

TEST(VulkanTexture, TypelessOnesHaveViewsOfTheirFamily) {
  KAAMOS_NEED_GPU(gpu);
  Harness h(gpu);
  TexelKernel kernel(gpu, *h.descriptors);
  auto desc = desc_of(1, 1, 1, 1, Format::kR8G8B8A8Typeless);
  desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  auto texture = h.textures->create_texture(desc);
  ASSERT_TRUE(texture) << texture.error().message;
  runtime::TextureViewDesc view;
  view.format = Format::kR8G8B8A8Unorm;
  view.unordered_access = true;
  const shader::Texel half = {{0x3F000000u, 0x3F800000u, 0, 0x3F800000u}};
  kernel.write(*h.textures->create_view(**texture, view), NumberClass::kFloat, 1, 1, half);
  view.unordered_access = false;
  view.format = Format::kR8G8B8A8UnormSrgb;
  auto texel = kernel.read(*h.textures->create_view(**texture, view), NumberClass::kFloat, 1, 1)[0];
  EXPECT_NEAR(std::bit_cast<float>(texel.bits[0]), 0.2158605, kSrgbTolerance);
  view.format = Format::kR8G8B8A8Uint;
  view.swizzle[0] = 1;
  view.swizzle[1] = 0;
  view.swizzle[2] = 5;
  view.swizzle[3] = 4;
  texel = kernel.read(*h.textures->create_view(**texture, view), NumberClass::kUint, 1, 1)[0];
  EXPECT_EQ(texel.bits[0], 255u);
  EXPECT_EQ(texel.bits[1], 128u);
  EXPECT_EQ(texel.bits[2], 1u);
  EXPECT_EQ(texel.bits[3], 0u);
}

TEST(VulkanTexture, AViewThatIsLeftOverReadsZero) {
  KAAMOS_NEED_GPU(gpu);
  if (!gpu->features().null_descriptor) GTEST_SKIP() << "the device has no null descriptors";
  Harness h(gpu);
  TexelKernel kernel(gpu, *h.descriptors);
  auto texture = *h.textures->create_texture(desc_of(4, 4, 1, 1, Format::kR32Uint));
  const auto source = h.buffer(1024);
  std::memset(source->host(), 0x55, 1024);
  ASSERT_TRUE(h.copy(upload_of(texture, source, 4, 4)));
  ASSERT_TRUE(h.stream.flush());
  runtime::TextureViewDesc view;
  view.format = Format::kR32Uint;
  const uint64_t index = *h.textures->create_view(*texture, view);
  EXPECT_EQ(index, *h.textures->create_view(*texture, view));
  EXPECT_EQ(kernel.read(index, NumberClass::kUint, 4, 4)[0].bits[0], 0x55555555u);
  texture.reset();
  for (int i = 0; i < 10; ++i) {
    auto other = *h.textures->create_texture(desc_of(4, 4, 1, 1, Format::kR32Uint));
    EXPECT_NE(*h.textures->create_view(*other, view), index);
  }
  EXPECT_EQ(kernel.read(index, NumberClass::kUint, 4, 4)[0].bits[0], 0u);
}

TEST(VulkanTexture, SomeSlicesAreCleared) {
  KAAMOS_NEED_GPU(gpu);
  Harness h(gpu);
  TexelKernel kernel(gpu, *h.descriptors);
  auto desc = desc_of(6, 5, 4, 2, Format::kR16G16Uint);
  desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  auto texture = *h.textures->create_texture(desc);
  runtime::TextureViewDesc view;
  view.format = desc.Format;
  view.dimension = rtapi::SrvDimension::kTexture2DArray;
  view.unordered_access = true;
  view.first_slice = 1;
  view.slice_count = 2;
  view.first_mip = 1;
  runtime::ClearUavCommand clear;
  clear.view.kind = shader::DescriptorKind::kTexture;
  clear.view.address = *h.textures->create_view(*texture, view);
  clear.values[0] = 70000;  // of which 16 bits are kept
  clear.values[1] = 5;
  clear.resource = std::shared_ptr<runtime::BackendTexture>(texture);
  ASSERT_TRUE(h.textures->clear(h.stream, clear));
  ASSERT_TRUE(h.stream.flush());
  for (uint32_t slice = 0; slice < 4; ++slice) {
    runtime::TextureViewDesc one;
    one.format = desc.Format;
    one.first_slice = slice;
    one.first_mip = 1;
    const auto texels =
        kernel.read(*h.textures->create_view(*texture, one), NumberClass::kUint, 3, 2);
    const bool cleared = slice == 1 || slice == 2;
    for (const auto& texel : texels) {
      EXPECT_EQ(texel.bits[0], cleared ? 70000u % 65536u : 0u);
      EXPECT_EQ(texel.bits[1], cleared ? 5u : 0u);
    }
  }
}

TEST(VulkanTexture, BuffersAreCleared) {
  KAAMOS_NEED_GPU(gpu);
  Harness h(gpu);
  const auto block = h.buffer(64);
  runtime::ClearUavCommand clear;
  clear.view.kind = shader::DescriptorKind::kRawBuffer;
  clear.view.address = block->address() + 16;
  clear.view.size_bytes = 16;
  clear.values[0] = 0xABCD;
  clear.resource = std::shared_ptr<runtime::BackendBuffer>(block);
  ASSERT_TRUE(h.textures->clear(h.stream, clear));
  const auto* words = reinterpret_cast<const uint32_t*>(block->host());
  EXPECT_EQ(words[3], 0u);
  EXPECT_EQ(words[4], 0xABCDu);
  EXPECT_EQ(words[7], 0xABCDu);
  EXPECT_EQ(words[8], 0u);
  clear.view.kind = shader::DescriptorKind::kTypedBuffer;
  clear.view.access = shader::DescriptorAccess::kUnorderedAccess;
  clear.view.format = static_cast<uint32_t>(Format::kR8G8B8A8Unorm);
  clear.is_float = true;
  for (uint32_t& value : clear.values) value = 0x3F800000u;
  ASSERT_TRUE(h.textures->clear(h.stream, clear));
  EXPECT_EQ(words[4], 0xFFFFFFFFu);
}

TEST(VulkanTexture, WhatTheDeviceLacksIsAnError) {
  KAAMOS_NEED_GPU(gpu);
  Harness h(gpu);
  const auto none = h.textures->create_texture(desc_of(4, 4, 1, 1, Format::kUnknown));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().id.text(), "KA0960");
  const auto large = h.textures->create_texture(desc_of(1u << 20, 1, 1, 1, Format::kR8Unorm));
  ASSERT_FALSE(large);
  EXPECT_EQ(large.error().id.text(), "KA0960");
}

TEST(VulkanSampler, EqualOnesAreOne) {
  KAAMOS_NEED_GPU(gpu);
  Harness h(gpu);
  rtapi::SamplerDesc desc;
  const auto a = *h.textures->create_sampler(desc);
  EXPECT_NE(a, 0u);
  EXPECT_EQ(a, *h.textures->create_sampler(desc));
  desc.AddressU = rtapi::TextureAddressMode::kClamp;
  EXPECT_NE(a, *h.textures->create_sampler(desc));
}

TEST(VulkanSampler, EveryKindCanBeMade) {
  KAAMOS_NEED_GPU(gpu);
  if (!gpu->is_lavapipe()) GTEST_SKIP() << "other devices may lack some";
  Harness h(gpu);
  for (const auto filter :
       {rtapi::Filter::kMinMagMipPoint, rtapi::Filter::kAnisotropic,
        rtapi::Filter::kComparisonMinMagMipLinear, rtapi::Filter::kMinimumMinMagMipLinear,
        rtapi::Filter::kMaximumMinMagMipPoint, rtapi::Filter::kComparisonAnisotropic}) {
    rtapi::SamplerDesc desc;
    desc.Filter = filter;
    desc.MaxAnisotropy = 16;
    desc.AddressU = rtapi::TextureAddressMode::kBorder;
    desc.AddressV = rtapi::TextureAddressMode::kMirrorOnce;
    desc.BorderColor[1] = 0.3f;
    desc.ComparisonFunc = rtapi::ComparisonFunc::kGreater;
    desc.MinLOD = 3;
    desc.MaxLOD = 1;
    const auto sampler = h.textures->create_sampler(desc);
    EXPECT_TRUE(sampler) << sampler.error().message;
  }
}

}  // namespace
}  // namespace kaamos::vulkan
