// SPDX-License-Identifier: MIT
//
// Block-compressed textures from copies to shaders: interpreted and native code on the CPU, and
// Vulkan. [D3D11.3 19.5]
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <random>
#include <span>

#include "tests/vulkan/support.h"
#include "twin_device.h"

namespace kaamos::test {
namespace {

using namespace rtapi;

using Block = std::array<uint8_t, 16>;
using Texels = std::vector<std::array<float, 4>>;

constexpr const char* kSource = R"(
Texture2DArray<float4> t : register(t0);
RWByteAddressBuffer results : register(u0);
cbuffer Arguments : register(b0) { uint mip; };

[shader("compute")] [numthreads(8, 8, 1)]
void ReadTexels(uint3 id : SV_DispatchThreadID) {
  results.Store4((id.y * 64 + id.x) * 16, asuint(t.Load(int4(id.xy, 0, mip))));
}
[shader("compute")] [numthreads(1, 1, 1)]
void ReadSizes() {
  for (uint i = 0; i < 4; ++i) {
    uint4 size;
    t.GetDimensions(i, size.x, size.y, size.z, size.w);
    results.Store4(i * 16, size);
  }
}
)";
constexpr uint32_t kGrid = 64;  // texels that ReadTexels takes, along a side

// A device in checked mode, which must have nothing to say.
class Executor {
 public:
  explicit Executor(const std::string& name) : twin_(name == "vulkan" ? "vulkan" : "embree") {
    DeviceDesc desc = {.Backend = twin_.device.GetDesc().Backend, .Checked = true};
    desc.OnMessage = [](const Message& m) { ADD_FAILURE() << m.Text; };
    twin_.device = CreateDevice(desc).value();
    twin_.queue = twin_.device.CreateCommandQueue().value();
    static std::map<std::string, Compiled> compiled;
    Compiled& code = compiled[name];
    if (code.library == nullptr) {
      hlsl::FrontendOptions options;
      options.path = "blocks.hlsl";
      options.text = kSource;
      code = name == "vulkan"   ? compile_vulkan(options)
             : name == "native" ? compile_native({options}).at(0)
                                : compile_interpreted(options);
    }
    EXPECT_EQ(code.error, "");
    library_ = LoadShaderLibrary(code.library).value();
    RootSignatureDesc root;
    root.Parameters = {
        RootParameter::Table({{.RangeType = DescriptorRangeType::kSrv, .NumDescriptors = 1}}),
        RootParameter::Uav(0, 0), RootParameter::Constants32(1, 0)};
    root_ = device().CreateRootSignature(root).value();
    heap_ = device()
                .CreateDescriptorHeap({DescriptorHeapType::kCbvSrvUav, 1,
                                       DescriptorHeapFlags::kShaderVisible, "views"})
                .value();
  }

  const Device& device() { return twin_.device; }
  CommandQueue& queue() { return twin_.queue; }

  Texture texture(uint32_t width, uint32_t height, Format format, uint16_t mips = 1,
                  uint16_t elements = 1) {
    TextureDesc desc;
    desc.Width = width;
    desc.Height = height;
    desc.DepthOrArraySize = elements;
    desc.MipLevels = mips;
    desc.Format = format;
    desc.Name = "blocks";
    return device().CreateTexture(desc).value();
  }
  void upload(const Texture& texture, uint32_t subresource, std::span<const uint8_t> bytes) {
    UploadTexture(device(), queue(), texture, subresource, std::as_bytes(bytes)).value();
  }
  std::vector<uint8_t> bytes(const Texture& texture, uint32_t subresource) {
    const auto read = ReadbackTexture(device(), queue(), texture, subresource).value();
    std::vector<uint8_t> out(read.size());
    std::memcpy(out.data(), read.data(), read.size());
    return out;
  }
  void copy(const TextureCopyLocation& dest, uint32_t x, uint32_t y,
            const TextureCopyLocation& source, const Box* box = nullptr) {
    using S = ResourceStates;
    const Texture& to = std::get<Texture>(dest.pResource);
    const Texture& from = std::get<Texture>(source.pResource);
    CommandList list = device().CreateCommandList().value();
    list.ResourceBarrier(ResourceBarrier::Transition(to, S::kCommon, S::kCopyDest));
    list.ResourceBarrier(ResourceBarrier::Transition(from, S::kCommon, S::kCopySource));
    list.CopyTextureRegion(dest, x, y, 0, source, box);
    list.ResourceBarrier(ResourceBarrier::Transition(to, S::kCopyDest, S::kCommon));
    list.ResourceBarrier(ResourceBarrier::Transition(from, S::kCopySource, S::kCommon));
    queue().ExecuteAndWait(list).value();
  }
  // kGrid x kGrid texels of a mip of an array element; zeros outside of it.
  Texels texels(const Texture& texture, Format format, uint32_t mip = 0, uint32_t element = 0) {
    const std::vector<uint32_t> words = run("ReadTexels", texture, format, mip, element);
    Texels out(size_t{kGrid} * kGrid);
    std::memcpy(out.data(), words.data(), words.size() * 4);
    return out;
  }
  std::vector<uint32_t> run(const char* entry, const Texture& texture, Format format, uint32_t mip,
                            uint32_t element) {
    ShaderResourceViewDesc view;
    view.Format = format;
    view.ViewDimension = SrvDimension::kTexture2DArray;
    view.Texture2DArray.FirstArraySlice = element;
    view.Texture2DArray.ArraySize = 1;
    device().CreateShaderResourceView(texture, view, heap_.GetCPUDescriptorHandle(0)).value();
    const auto state = ResourceStates::kNonPixelShaderResource;
    const Buffer output = twin_.output(size_t{kGrid} * kGrid * 16);
    CommandList list = device().CreateCommandList().value();
    list.ResourceBarrier(ResourceBarrier::Transition(texture, ResourceStates::kCommon, state));
    list.SetDescriptorHeaps({heap_});
    list.SetComputeRootSignature(root_);
    list.SetPipelineState(
        device().CreateComputePipelineState({root_, library_, entry, ""}).value());
    list.SetComputeRootDescriptorTable(0, heap_.GetGPUDescriptorHandle(0));
    list.SetComputeRootUnorderedAccessView(1, output.GetGPUVirtualAddress());
    list.SetComputeRoot32BitConstants(2, 1, &mip, 0);
    list.Dispatch(kGrid / 8, kGrid / 8, 1);
    list.ResourceBarrier(ResourceBarrier::Transition(texture, state, ResourceStates::kCommon));
    queue().ExecuteAndWait(list).value();
    return twin_.words(output);
  }

 private:
  TwinDevice twin_;
  ShaderLibrary library_;
  RootSignature root_;
  DescriptorHeap heap_;
};

struct BlockCase {
  const char* name;
  Format format;
  Block solid;  // one colour
  std::array<float, 4> colour;
};
const BlockCase kCases[] = {
    {"bc1", Format::kBC1Unorm, {0x00, 0xF8, 0x00, 0xF8}, {1, 0, 0, 1}},
    {"bc1_srgb", Format::kBC1UnormSrgb, {0xE0, 0x07, 0xE0, 0x07}, {0, 1, 0, 1}},
    {"bc2",
     Format::kBC2Unorm,
     {0x99, 0x99, 0x99, 0x99, 0x99, 0x99, 0x99, 0x99, 0x1F, 0xF8, 0x1F, 0xF8},
     {1, 0, 1, 153 / 255.0f}},
    {"bc2_srgb",
     Format::kBC2UnormSrgb,
     {0x33, 0x33, 0x33, 0x33, 0x33, 0x33, 0x33, 0x33, 0x1F, 0x00, 0x1F, 0x00},
     {0, 0, 1, 51 / 255.0f}},
    {"bc3",
     Format::kBC3Unorm,
     {51, 51, 0, 0, 0, 0, 0, 0, 0xFF, 0x07, 0xFF, 0x07},
     {0, 1, 1, 51 / 255.0f}},
    {"bc3_srgb",
     Format::kBC3UnormSrgb,
     {51, 51, 0, 0, 0, 0, 0, 0, 0xFF, 0x07, 0xFF, 0x07},
     {0, 1, 1, 51 / 255.0f}},
    {"bc4", Format::kBC4Unorm, {51, 51}, {51 / 255.0f, 0, 0, 1}},
    {"bc4_snorm", Format::kBC4Snorm, {0xC0, 0xC0}, {-64 / 127.0f, 0, 0, 1}},
    {"bc5", Format::kBC5Unorm, {51, 51, 0, 0, 0, 0, 0, 0, 255, 255}, {51 / 255.0f, 1, 0, 1}},
    {"bc5_snorm",
     Format::kBC5Snorm,
     {0xC0, 0xC0, 0, 0, 0, 0, 0, 0, 127, 127},
     {-64 / 127.0f, 1, 0, 1}},
    // Mode 01111 with endpoints of 31711 in all channels: 31711 * 31 / 64 is 0x3C00 as a half
    // float.
    {"bc6h",
     Format::kBC6HUf16,
     {0xEF, 0xFB, 0xEF, 0xBF, 0x07, 0x0F, 0x3C, 0xF0, 0x00, 0x00},
     {1, 1, 1, 1}},
    // 15856 * 31 / 32.
    {"bc6h_signed",
     Format::kBC6HSf16,
     {0x0F, 0x3E, 0xF8, 0xE0, 0x03, 0x1E, 0x78, 0xE0, 0x01, 0x00},
     {1, 1, 1, 1}},
    // Mode 6: endpoints of 25, 76, 127 and 0, lowest bits 1.
    {"bc7",
     Format::kBC7Unorm,
     {0xC0, 0x4C, 0x86, 0xC9, 0xFC, 0xFF, 0x01, 0x80, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
      0x00},
     {51 / 255.0f, 153 / 255.0f, 1, 1 / 255.0f}},
};

uint32_t bytes_of(Format format) {
  return GetFormatInfo(format).bytes;
}

// Blocks of all modes.
std::vector<uint8_t> random_blocks(Format format, uint32_t count, uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<uint8_t> out(size_t{count} * bytes_of(format));
  for (uint8_t& byte : out) byte = static_cast<uint8_t>(random());
  for (uint32_t i = 0; i < count; ++i) {
    uint8_t& first = out[size_t{i} * bytes_of(format)];
    if (format == Format::kBC7Unorm) {
      first = static_cast<uint8_t>(i % 9 == 8 ? 0u : (first | 1u) << (i % 9));
    } else if (format == Format::kBC6HUf16 || format == Format::kBC6HSf16) {
      first = static_cast<uint8_t>((first & 0xE0u) | i % 32);
    }
  }
  return out;
}

class BlockTextures : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() != "vulkan") return;
    if (const std::string why = why_no_vulkan(); !why.empty()) {
      if (vulkan_is_required()) FAIL() << why;
      GTEST_SKIP() << why;
    }
    guard_.emplace();
  }

 private:
  std::optional<ValidationGuard> guard_;
};

TEST_P(BlockTextures, HaveTheirColours) {
  Executor e(GetParam());
  // Mesa multiplies by a rounded 1 / 255.
  const float tolerance = GetParam() == "vulkan" ? 1e-7f : 0.0f;
  for (const BlockCase& c : kCases) {
    SCOPED_TRACE(c.name);
    const Texture texture = e.texture(7, 5, c.format);
    std::vector<uint8_t> data;
    for (int i = 0; i < 4; ++i) {
      data.insert(data.end(), c.solid.begin(), c.solid.begin() + bytes_of(c.format));
    }
    e.upload(texture, 0, data);
    const Texels texels = e.texels(texture, c.format);
    for (uint32_t y = 0; y < 8; ++y) {
      for (uint32_t x = 0; x < 8; ++x) {
        const auto wanted = x < 7 && y < 5 ? c.colour : std::array<float, 4>{};
        for (size_t i = 0; i < 4; ++i) {
          EXPECT_NEAR(texels[y * kGrid + x][i], wanted[i], tolerance) << x << " " << y << " " << i;
        }
      }
    }
  }
}

// 13 x 9 texels, down to 1 x 1, twice.
TEST_P(BlockTextures, GiveBackTheirBlocks) {
  Executor e(GetParam());
  constexpr uint32_t kBlocks[4] = {4 * 3, 2 * 1, 1, 1};
  for (const BlockCase& c : kCases) {
    SCOPED_TRACE(c.name);
    const Texture texture = e.texture(13, 9, c.format, 4, 2);
    for (uint32_t i = 0; i < 8; ++i) {
      const size_t size = size_t{kBlocks[i % 4]} * bytes_of(c.format);
      EXPECT_EQ(e.bytes(texture, i), std::vector<uint8_t>(size)) << i;
      e.upload(texture, i, random_blocks(c.format, kBlocks[i % 4], 100 + i));
    }
    for (uint32_t i = 0; i < 8; ++i) {
      EXPECT_EQ(e.bytes(texture, i), random_blocks(c.format, kBlocks[i % 4], 100 + i)) << i;
    }
    const Texture other = e.texture(13, 9, c.format, 4, 2);
    for (uint32_t i = 0; i < 8; ++i) e.copy({other, i}, 0, 0, {texture, i});
    for (uint32_t i = 0; i < 8; ++i) EXPECT_EQ(e.bytes(other, i), e.bytes(texture, i)) << i;
  }
}

TEST_P(BlockTextures, HaveTheSizesOfTheirTexels) {
  Executor e(GetParam());
  const Texture texture = e.texture(13, 9, Format::kBC3Unorm, 4);
  const auto words = e.run("ReadSizes", texture, Format::kBC3Unorm, 0, 0);
  const uint32_t wanted[4][4] = {{13, 9, 1, 4}, {6, 4, 1, 4}, {3, 2, 1, 4}, {1, 1, 1, 4}};
  for (uint32_t i = 0; i < 4; ++i) {
    for (uint32_t k = 0; k < 4; ++k) EXPECT_EQ(words[i * 4 + k], wanted[i][k]) << i << " " << k;
  }
}

// The blocks of a picture of 10 x 6 texels, which are 3 x 2, as integers; and back to elsewhere.
TEST_P(BlockTextures, AreCopiedToAndFromIntegers) {
  Executor e(GetParam());
  for (const BlockCase& c : kCases) {
    SCOPED_TRACE(c.name);
    const Format integers =
        bytes_of(c.format) == 8 ? Format::kR32G32Uint : Format::kR32G32B32A32Uint;
    const auto data = random_blocks(c.format, 6, 5);
    const Texture blocks = e.texture(10, 6, c.format);
    e.upload(blocks, 0, data);
    const Texture words = e.texture(3, 2, integers);
    e.copy({words, 0}, 0, 0, {blocks, 0});
    EXPECT_EQ(e.bytes(words, 0), data);
    // Block (2, 1) to (0, 1) and (1, 1) of a picture of 5 x 8; the second is cut off.
    const Texture other = e.texture(5, 8, c.format);
    const Box texel = {2, 1, 0, 3, 2, 1};
    const Box corner = {8, 4, 0, 10, 6, 1};
    e.copy({other, 0}, 0, 4, {words, 0}, &texel);
    e.copy({other, 0}, 4, 4, {blocks, 0}, &corner);
    const uint32_t n = bytes_of(c.format);
    std::vector<uint8_t> wanted(size_t{4} * n);
    std::memcpy(&wanted[size_t{2} * n], &data[size_t{5} * n], n);
    std::memcpy(&wanted[size_t{3} * n], &data[size_t{5} * n], n);
    EXPECT_EQ(e.bytes(other, 0), wanted);
    const Texels from = e.texels(blocks, c.format), to = e.texels(other, c.format);
    for (uint32_t y = 0; y < 2; ++y) {
      EXPECT_EQ(std::memcmp(&from[(4 + y) * kGrid + 8], &to[(4 + y) * kGrid], 32), 0) << y;
      EXPECT_EQ(std::memcmp(&from[(4 + y) * kGrid + 8], &to[(4 + y) * kGrid + 4], 16), 0) << y;
    }
  }
}

// Views of both kinds are made before and between copies; each shows what is there.
TEST_P(BlockTextures, AreSeenThroughViewsOfTheirFamily) {
  Executor e(GetParam());
  const auto fill = [](uint8_t value, uint32_t count) {
    std::vector<uint8_t> data(size_t{8} * count);
    for (uint32_t i = 0; i < count; ++i) data[8 * i] = data[8 * i + 1] = value;
    return data;
  };
  const Texture texture = e.texture(8, 8, Format::kBC4Typeless, 2, 2);
  const Texture patch = e.texture(4, 4, Format::kBC4Typeless);
  const auto red = [&](Format format, uint32_t x, uint32_t y, uint32_t mip, uint32_t element) {
    return e.texels(texture, format, mip, element)[y * kGrid + x][0];
  };
  EXPECT_FLOAT_EQ(red(Format::kBC4Unorm, 0, 0, 0, 0), 0.0f);
  e.upload(texture, 0, fill(0x81, 4));
  e.upload(texture, 3, fill(0x33, 1));
  EXPECT_FLOAT_EQ(red(Format::kBC4Unorm, 7, 7, 0, 0), 129 / 255.0f);
  EXPECT_FLOAT_EQ(red(Format::kBC4Snorm, 7, 7, 0, 0), -1.0f);
  e.upload(patch, 0, fill(0x7F, 1));
  e.copy({texture, 0}, 4, 0, {patch, 0});
  EXPECT_FLOAT_EQ(red(Format::kBC4Snorm, 4, 3, 0, 0), 1.0f);
  EXPECT_FLOAT_EQ(red(Format::kBC4Snorm, 3, 3, 0, 0), -1.0f);
  EXPECT_FLOAT_EQ(red(Format::kBC4Unorm, 7, 0, 0, 0), 127 / 255.0f);
  EXPECT_FLOAT_EQ(red(Format::kBC4Unorm, 3, 3, 1, 1), 0.2f);
  EXPECT_FLOAT_EQ(red(Format::kBC4Unorm, 3, 3, 0, 1), 0.0f);
}

INSTANTIATE_TEST_SUITE_P(Executors, BlockTextures, testing::Values("embree", "native", "vulkan"),
                         [](const auto& tested) { return tested.param; });

// BC6H and BC7 are exact, but for Mesa's rounded 1 / 255. Palettes of BC1 to BC3 may be rounded
// differently, by one step of 255 [D3D11.3 19.5.2], which is up to 2.28 steps after the curve of
// sRGB; Mesa's curve errs by 0.0012. It computes those of BC4, BC5 and BC3's alpha in 8 bits, and
// is up to two steps off, where D3D asks for 16 bits.
float tolerance_of(Format format) {
  switch (format) {
    case Format::kBC6HUf16:
    case Format::kBC6HSf16:
      return 0.0f;
    case Format::kBC7Unorm:
      return 1e-7f;
    case Format::kBC1Unorm:
    case Format::kBC2Unorm:
      return 1.001f / 255;
    case Format::kBC1UnormSrgb:
    case Format::kBC2UnormSrgb:
    case Format::kBC3UnormSrgb:
      return 2.28f / 255 + 1.2e-3f;
    case Format::kBC4Snorm:
    case Format::kBC5Snorm:
      return 2.0f / 127;
    default:
      return 2.0f / 255;
  }
}

TEST(BlockTextureTwins, ReadAlike) {
  KAAMOS_NEED_VULKAN();
  Executor cpu("embree"), gpu("vulkan");
  for (const BlockCase& c : kCases) {
    SCOPED_TRACE(c.name);
    const auto data = random_blocks(c.format, kGrid * kGrid / 16, 11);
    const auto read = [&](Executor& e) {
      const Texture texture = e.texture(kGrid, kGrid, c.format);
      e.upload(texture, 0, data);
      return e.texels(texture, c.format);
    };
    const Texels expected = read(cpu), actual = read(gpu);
    for (size_t i = 0; i < expected.size(); ++i) {
      for (size_t k = 0; k < 4; ++k) {
        ASSERT_NEAR(expected[i][k], actual[i][k], tolerance_of(c.format))
            << "texel " << i << ", channel " << k;
      }
    }
  }
}

}  // namespace
}  // namespace kaamos::test
