// SPDX-License-Identifier: MIT
//
// Textures on Vulkan against the CPU's: samples of every dimension with filters, address modes and
// offsets; gathers; comparisons; texel loads.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <span>

#include "tests/vulkan/support.h"
#include "twin_device.h"

namespace kaamos::test {
namespace {

using namespace rtapi;

constexpr uint32_t kPoints = 256;
constexpr uint32_t kWidth = 8, kHeight = 4, kDepth = 6, kMips = 3;
constexpr uint32_t kSamplers = 8;

struct TextureCase {
  const char* name;  // the part of the HLSL type after "Texture"
  ResourceDimension resource;
  SrvDimension srv;
  int location;  // number of components of a sample's location
  int offset;    // number of components of an offset; 0: cubes have none
  bool gathers;
  bool compares;
};
constexpr TextureCase kTextures[] = {
    {"1D", ResourceDimension::kTexture1D, SrvDimension::kTexture1D, 1, 1, false, true},
    {"1DArray", ResourceDimension::kTexture1D, SrvDimension::kTexture1DArray, 2, 1, false, true},
    {"2D", ResourceDimension::kTexture2D, SrvDimension::kTexture2D, 2, 2, true, true},
    {"2DArray", ResourceDimension::kTexture2D, SrvDimension::kTexture2DArray, 3, 2, true, true},
    {"3D", ResourceDimension::kTexture3D, SrvDimension::kTexture3D, 3, 3, false, false},
    {"Cube", ResourceDimension::kTexture2D, SrvDimension::kTextureCube, 3, 0, true, true},
    {"CubeArray", ResourceDimension::kTexture2D, SrvDimension::kTextureCubeArray, 4, 0, true,
     true}};

struct SampledFormat {
  const char* name;
  Format format;
  uint32_t bytes;
};
constexpr SampledFormat kSampledFormats[] = {{"rgba32f", Format::kR32G32B32A32Float, 16},
                                             {"rgba8", Format::kR8G8B8A8Unorm, 4},
                                             {"rgba8_srgb", Format::kR8G8B8A8UnormSrgb, 4},
                                             {"r32f", Format::kR32Float, 4},
                                             {"rg16f", Format::kR16G16Float, 4}};
constexpr SampledFormat kBc1 = {"bc1", Format::kBC1Unorm, 8}, kBc5 = {"bc5", Format::kBC5Unorm, 16},
                        kBc6h = {"bc6h", Format::kBC6HUf16, 16},
                        kBc7 = {"bc7", Format::kBC7Unorm, 16};

bool is_blocks(const SampledFormat& format) {
  return GetFormatInfo(format.format).block_side != 1;
}

// Makes a block of random bytes one that every implementation decodes to the same texels.
void adjust_block(Format format, uint8_t* block, std::mt19937& random) {
  uint64_t halves[2];
  std::memcpy(halves, block, format == Format::kBC1Unorm ? 8 : 16);
  if (format == Format::kBC1Unorm) {
    halves[0] &= 0x55555555FFFFFFFFu;  // no colour between the two that are stored
    std::memcpy(block, halves, 8);
    return;
  }
  if (format == Format::kBC5Unorm) {
    for (uint64_t& half : halves) half &= 0x249249249249FFFFu;
  } else if (format == Format::kBC6HUf16) {
    halves[0] = 3;  // one subset; six endpoints of 10 bits, below 0.8 as half floats
    for (uint32_t i = 0; i < 6; ++i) halves[0] |= uint64_t{random() % 480} << (5 + 10 * i);
    halves[1] &= ~uint64_t{1};
  }
  std::memcpy(block, halves, 16);
}

// The kernel's operations; each gives four floats.
std::vector<std::string> operations_of(const TextureCase& t) {
  const char* const kTypes[] = {"", "float", "float2", "float3", "float4"};
  const std::string spatial = std::string(t.name).starts_with("1D") ? "float"
                              : t.offset == 2                       ? "float2"
                                                                    : "float3";
  const std::string gradient_x = spatial == "float"    ? "p.w * 0.5"
                                 : spatial == "float2" ? "float2(p.w * 0.5, 0)"
                                                       : "float3(p.w * 0.5, 0, 0)";
  const std::string gradient_y = spatial == "float"    ? "0.01"
                                 : spatial == "float2" ? "float2(0, 0.01)"
                                                       : "float3(0, 0.01, 0)";
  const std::string at = std::string("(") + kTypes[t.location] + ")at";
  const std::string texel_type =
      std::string("int") +
      std::to_string(t.location + (t.srv == SrvDimension::kTexture1D ||
                                           t.srv == SrvDimension::kTexture1DArray ||
                                           t.srv == SrvDimension::kTexture2D ||
                                           t.srv == SrvDimension::kTexture2DArray ||
                                           t.srv == SrvDimension::kTexture3D
                                       ? 1
                                       : 0));
  std::vector<std::string> out = {"t.SampleLevel(s[k], " + at + ", 0)",
                                  "t.SampleLevel(s[k], " + at + ", p.w)"};
  if (t.srv != SrvDimension::kTextureCubeArray && t.srv != SrvDimension::kTextureCube) {
    out.push_back("t.SampleGrad(s[k], " + at + ", " + gradient_x + ", " + gradient_y + ")");
    const char* const kOffsets[] = {"", "-1", "int2(2, -1)", "int3(1, -2, 1)"};
    const std::string offset = kOffsets[t.offset];
    out.push_back("t.SampleLevel(s[k], " + at + ", 0, " + offset + ")");
    out.push_back("t.SampleLevel(s[k], " + at + ", p.w, " + offset + ")");
    out.push_back("t.SampleGrad(s[k], " + at + ", " + gradient_x + ", " + gradient_y + ", " +
                  offset + ")");
    // An offset that the compiler does not know.
    out.push_back("t.SampleLevel(s[k], " + at + ", 1, " + offset + " * (texel.w > -9 ? 1 : 0))");
    if (t.compares) {
      out.push_back("t.SampleCmpLevelZero(c[k], " + at + ", p.w / 4, " + offset + ")");
    }
    out.push_back("t.Load(" + texel_type + "(texel." + std::string("xyz").substr(0, t.location) +
                  ", texel.w))");
    out.push_back("t.Load(" + texel_type + "(texel." + std::string("xyz").substr(0, t.location) +
                  ", texel.w), " + offset + ")");
    if (t.gathers) out.push_back("t.GatherGreen(s[k], " + at + ", " + offset + ")");
  }
  if (t.gathers) {
    out.push_back("t.GatherRed(s[k], " + at + ")");
    out.push_back("t.GatherAlpha(s[k], " + at + ")");
    out.push_back("t.GatherCmp(c[k], " + at + ", p.w / 4)");
  }
  if (t.compares) out.push_back("t.SampleCmpLevelZero(c[k], " + at + ", p.w / 4)");
  return out;
}

std::string texture_source(const TextureCase& t) {
  std::string text = "Texture" + std::string(t.name) +
                     "<float4> t : register(t0);\n"
                     "SamplerState s[8] : register(s0);\n"
                     "SamplerComparisonState c[8] : register(s8);\n"
                     "ByteAddressBuffer points : register(t1);\n"
                     "RWByteAddressBuffer results : register(u0);\n"
                     "[shader(\"compute\")] [numthreads(64, 1, 1)]\n"
                     "void main(uint3 id : SV_DispatchThreadID) {\n"
                     "  const uint k = id.y;\n"
                     "  const float4 at = points.Load<float4>(id.x * 48);\n"
                     "  const float4 p = points.Load<float4>(id.x * 48 + 16);\n"
                     "  const int4 texel = points.Load<int4>(id.x * 48 + 32);\n";
  const auto operations = operations_of(t);
  for (size_t i = 0; i < operations.size(); ++i) {
    text += "  results.Store4((((" + std::to_string(i) + " * 8 + k) * " + std::to_string(kPoints) +
            ") + id.x) * 16, asuint((float4)" + operations[i] + "));\n";
  }
  return text + "}\n";
}

SamplerDesc sampler(uint32_t index, bool comparison) {
  using M = TextureAddressMode;
  struct Row {
    uint32_t filter;
    M mode;
  };
  constexpr Row kRows[kSamplers] = {{0, M::kClamp},      {0, M::kWrap},      {0x15, M::kClamp},
                                    {0x15, M::kWrap},    {0x14, M::kMirror}, {0x15, M::kBorder},
                                    {1, M::kMirrorOnce}, {0x10, M::kBorder}};
  SamplerDesc desc;
  desc.Filter = static_cast<Filter>(kRows[index].filter | (comparison ? 0x80 : 0));
  desc.AddressU = desc.AddressV = desc.AddressW = kRows[index].mode;
  desc.ComparisonFunc = comparison ? ComparisonFunc::kLessEqual : ComparisonFunc::kNever;
  for (float& component : desc.BorderColor) component = index == 5 ? 1.0f : 0.0f;
  return desc;
}

// Takes the sides of mip 0 and the number of elements or faces.
TextureDesc texture_desc(const TextureCase& t, Format format) {
  const bool cube = t.offset == 0;
  TextureDesc desc;
  desc.Dimension = t.resource;
  desc.Width = kWidth;
  desc.Height = t.resource == ResourceDimension::kTexture1D ? 1 : cube ? kWidth : kHeight;
  desc.DepthOrArraySize =
      static_cast<uint16_t>(cube                                          ? 12
                            : t.resource == ResourceDimension::kTexture3D ? kDepth
                                                                          : 3);
  desc.MipLevels = kMips;
  desc.Format = format;
  return desc;
}

std::vector<float> sample_all(const char* backend, const TextureCase& t,
                              const SampledFormat& format, const std::vector<uint32_t>& points) {
  TwinDevice twin(backend);
  const Device& device = twin.device;
  Compiled code;
  const ShaderLibrary library = twin.compile(texture_source(t), code);
  if (!library) return {};
  const TextureDesc desc = texture_desc(t, format.format);
  const Texture texture = device.CreateTexture(desc).value();
  std::mt19937 random(7);
  for (uint32_t i = 0; i < texture.subresource_count(); ++i) {
    const uint32_t mip = i % kMips;
    const bool volume = t.resource == ResourceDimension::kTexture3D;
    const uint32_t side = GetFormatInfo(format.format).block_side;
    const auto elements = [&](uint32_t size) {
      return (std::max(1u, size >> mip) + side - 1) / side;
    };
    std::vector<uint8_t> data(size_t{elements(desc.Width)} * elements(desc.Height) *
                              (volume ? std::max(1u, kDepth >> mip) : 1) * format.bytes);
    const bool halves = format.format == Format::kR16G16Float;
    const bool floats =
        format.format == Format::kR32Float || format.format == Format::kR32G32B32A32Float;
    for (size_t b = 0; b < data.size(); ++b) data[b] = static_cast<uint8_t>(random());
    for (size_t b = 0; floats && b < data.size(); b += 4) {
      const float value = static_cast<float>(random() % 1024) / 1024;
      std::memcpy(&data[b], &value, 4);
    }
    for (size_t b = 0; halves && b < data.size(); b += 2) {  // 0.5 to 2
      data[b + 1] = static_cast<uint8_t>(0x38 | (data[b + 1] & 7));
    }
    for (size_t b = 0; is_blocks(format) && b < data.size(); b += format.bytes) {
      adjust_block(format.format, &data[b], random);
    }
    UploadTexture(device, twin.queue, texture, i, std::as_bytes(std::span(data))).value();
  }
  const auto heap_of = [&](DescriptorHeapType type, uint32_t count) {
    return device.CreateDescriptorHeap({type, count, DescriptorHeapFlags::kShaderVisible, "twins"})
        .value();
  };
  const DescriptorHeap views = heap_of(DescriptorHeapType::kCbvSrvUav, 1);
  const DescriptorHeap samplers = heap_of(DescriptorHeapType::kSampler, 2 * kSamplers);
  ShaderResourceViewDesc view;
  view.Format = format.format;
  view.ViewDimension = t.srv;
  device.CreateShaderResourceView(texture, view, views.GetCPUDescriptorHandle(0)).value();
  for (uint32_t i = 0; i < 2 * kSamplers; ++i) {
    device.CreateSampler(sampler(i % kSamplers, i >= kSamplers), samplers.GetCPUDescriptorHandle(i))
        .value();
  }
  RootSignatureDesc root_desc;
  root_desc.Parameters = {
      RootParameter::Table({{.RangeType = DescriptorRangeType::kSrv, .NumDescriptors = 1}}),
      RootParameter::Table(
          {{.RangeType = DescriptorRangeType::kSampler, .NumDescriptors = 2 * kSamplers}}),
      RootParameter::Srv(1, 0), RootParameter::Uav(0, 0)};
  const RootSignature root = device.CreateRootSignature(root_desc).value();
  const Buffer input = CreateUploadBuffer(device, points).value();
  const Buffer output = twin.output(operations_of(t).size() * kSamplers * kPoints * 16);
  CommandList list = device.CreateCommandList().value();
  list.SetDescriptorHeaps({views, samplers});
  list.SetComputeRootSignature(root);
  list.SetPipelineState(device.CreateComputePipelineState({root, library, "", ""}).value());
  list.SetComputeRootDescriptorTable(0, views.GetGPUDescriptorHandle(0));
  list.SetComputeRootDescriptorTable(1, samplers.GetGPUDescriptorHandle(0));
  list.SetComputeRootShaderResourceView(2, input.GetGPUVirtualAddress());
  list.SetComputeRootUnorderedAccessView(3, output.GetGPUVirtualAddress());
  list.Dispatch(kPoints / 64, kSamplers, 1);
  twin.queue.ExecuteAndWait(list).value();
  const std::vector<uint32_t> words = twin.words(output);
  std::vector<float> out;
  for (const uint32_t word : words) out.push_back(std::bit_cast<float>(word));
  return out;
}

// Locations at least 1/32 texel away from edges between texels, where rounding would decide.
std::vector<uint32_t> points_of(const TextureCase& t) {
  std::mt19937 random(3);
  std::vector<uint32_t> out;
  const auto uniform = [&] { return static_cast<float>(random() % 4096) / 4096; };
  const auto put = [&](float value) { out.push_back(std::bit_cast<uint32_t>(value)); };
  const int array = t.name[std::strlen(t.name) - 1] == 'y' ? t.location - 1 : -1;
  for (uint32_t i = 0; i < kPoints; ++i) {
    for (int c = 0; c < 4; ++c) {
      if (c == array) {
        put(static_cast<float>(random() % 6) - 1 + (i % 2 == 0 ? 0.25f : 0.0f));
      } else if (t.offset == 0) {
        put(uniform() * 2 - 1);
      } else {
        const float fraction = (static_cast<float>(random() % 14) + 1.5f) / 16;
        const float texel = static_cast<float>(static_cast<int>(random() % 24) - 8) + fraction;
        put(texel / static_cast<float>(c == 0 ? kWidth : c == 1 ? kHeight : kDepth));
      }
    }
    put(0), put(0), put(0),  // A level of x.5 is equally close to both mips.
        put(static_cast<float>(random() % 64) / 16 - 0.53125f);
    for (int c = 0; c < 3; ++c) out.push_back(random() % 10 - 1);
    out.push_back(random() % 4 - (i % 16 == 0 ? 1 : 0));
  }
  return out;
}

using TextureParameter = std::tuple<TextureCase, SampledFormat>;
class VulkanTextureTwins : public testing::TestWithParam<TextureParameter> {};

TEST_P(VulkanTextureTwins, SampleAlike) {
  KAAMOS_NEED_VULKAN();
  const auto& [t, format] = GetParam();
  const std::vector<uint32_t> points = points_of(t);
  const auto expected = sample_all("embree", t, format, points);
  const auto actual = sample_all("vulkan", t, format, points);
  ASSERT_EQ(expected.size(), actual.size());
  const auto operations = operations_of(t);
  // lavapipe decodes sRGB with a polynomial, within D3D's tolerance of 0.6 steps. It filters 8-bit
  // formats in 8 bits, which workaround FILTER fixes.
  const float tolerance = format.format == Format::kR8G8B8A8UnormSrgb ? 1.0f / 512 : 1.0f / 4096;
  for (size_t op = 0; op < operations.size(); ++op) {
    for (uint32_t k = 0; k < kSamplers; ++k) {
      size_t wrong = 0;
      float worst = 0;
      std::string first;
      for (uint32_t i = 0; i < kPoints; ++i) {
        const size_t at = ((op * kSamplers + k) * kPoints + i) * 4;
        float difference = 0;
        for (int c = 0; c < 4; ++c) {
          difference = std::max(difference, std::fabs(expected[at + c] - actual[at + c]));
        }
        worst = std::max(worst, difference);
        if (difference <= tolerance || ++wrong > 2) continue;
        char line[400];
        const auto* p = reinterpret_cast<const float*>(&points[i * 12]);
        std::snprintf(line, sizeof(line),
                      "  at (%g %g %g %g) %g: expected %g %g %g %g, is %g %g %g %g\n", double(p[0]),
                      double(p[1]), double(p[2]), double(p[3]), double(p[7]), double(expected[at]),
                      double(expected[at + 1]), double(expected[at + 2]), double(expected[at + 3]),
                      double(actual[at]), double(actual[at + 1]), double(actual[at + 2]),
                      double(actual[at + 3]));
        first += line;
      }
      EXPECT_EQ(wrong, 0u) << operations[op] << ", sampler " << k << ", worst " << worst << "\n"
                           << first;
    }
  }
}
std::string name_of(const testing::TestParamInfo<TextureParameter>& p) {
  return std::string(std::get<0>(p.param).name) + "_" + std::get<1>(p.param).name;
}
INSTANTIATE_TEST_SUITE_P(Dimensions, VulkanTextureTwins,
                         testing::Combine(testing::ValuesIn(kTextures),
                                          testing::ValuesIn(kSampledFormats)),
                         name_of);
// The decoding of blocks does not depend on the dimension.
INSTANTIATE_TEST_SUITE_P(
    Blocks, VulkanTextureTwins,
    testing::Values(TextureParameter{kTextures[2], kBc1}, TextureParameter{kTextures[2], kBc7},
                    TextureParameter{kTextures[3], kBc5}, TextureParameter{kTextures[4], kBc7},
                    TextureParameter{kTextures[5], kBc6h}, TextureParameter{kTextures[6], kBc1}),
    name_of);

}  // namespace
}  // namespace kaamos::test
