// SPDX-License-Identifier: MIT
//
// Typed buffers on Vulkan against the CPU's: decoding and encoding the elements of every format,
// inside and past the end of the view.
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

constexpr uint32_t kElements = 1024;  // read and written by shaders
constexpr uint32_t kViewed = 1000;    // covered by the views

struct ElementFormat {
  Format format;
  char number;  // f, u, i
  uint32_t bytes;
};
constexpr ElementFormat kElementFormats[] = {{Format::kR32G32B32A32Float, 'f', 16},
                                             {Format::kR32G32B32A32Uint, 'u', 16},
                                             {Format::kR32G32B32A32Sint, 'i', 16},
                                             {Format::kR32G32B32Float, 'f', 12},
                                             {Format::kR16G16B16A16Float, 'f', 8},
                                             {Format::kR16G16B16A16Unorm, 'f', 8},
                                             {Format::kR16G16B16A16Uint, 'u', 8},
                                             {Format::kR16G16B16A16Snorm, 'f', 8},
                                             {Format::kR16G16B16A16Sint, 'i', 8},
                                             {Format::kR32G32Float, 'f', 8},
                                             {Format::kR32G32Uint, 'u', 8},
                                             {Format::kR32G32Sint, 'i', 8},
                                             {Format::kR10G10B10A2Unorm, 'f', 4},
                                             {Format::kR10G10B10A2Uint, 'u', 4},
                                             {Format::kR11G11B10Float, 'f', 4},
                                             {Format::kR8G8B8A8Unorm, 'f', 4},
                                             {Format::kR8G8B8A8Uint, 'u', 4},
                                             {Format::kR8G8B8A8Snorm, 'f', 4},
                                             {Format::kR8G8B8A8Sint, 'i', 4},
                                             {Format::kR16G16Float, 'f', 4},
                                             {Format::kR16G16Unorm, 'f', 4},
                                             {Format::kR16G16Uint, 'u', 4},
                                             {Format::kR16G16Snorm, 'f', 4},
                                             {Format::kR16G16Sint, 'i', 4},
                                             {Format::kR32Float, 'f', 4},
                                             {Format::kR32Uint, 'u', 4},
                                             {Format::kR32Sint, 'i', 4},
                                             {Format::kR8G8Unorm, 'f', 2},
                                             {Format::kR8G8Uint, 'u', 2},
                                             {Format::kR8G8Snorm, 'f', 2},
                                             {Format::kR8G8Sint, 'i', 2},
                                             {Format::kR16Float, 'f', 2},
                                             {Format::kR16Unorm, 'f', 2},
                                             {Format::kR16Uint, 'u', 2},
                                             {Format::kR16Snorm, 'f', 2},
                                             {Format::kR16Sint, 'i', 2},
                                             {Format::kR8Unorm, 'f', 1},
                                             {Format::kR8Uint, 'u', 1},
                                             {Format::kR8Snorm, 'f', 1},
                                             {Format::kR8Sint, 'i', 1}};

std::string typed_source(char number) {
  const std::string type = number == 'f' ? "float4" : number == 'u' ? "uint4" : "int4";
  const std::string from = number == 'f' ? "asfloat" : number == 'u' ? "" : "asint";
  return "Buffer<" + type + "> source : register(t0);\nRWBuffer<" + type +
         "> target : register(u1);\n"
         "ByteAddressBuffer values : register(t1);\nRWByteAddressBuffer results : register(u0);\n"
         "[shader(\"compute\")] [numthreads(64, 1, 1)]\n"
         "void main(uint3 id : SV_DispatchThreadID) {\n"
         "  results.Store4(id.x * 16, asuint(source[id.x]));\n"
         "  target[id.x] = " +
         from +
         "(values.Load4(id.x * 16));\n"
         "}\n";
}

struct TypedResults {
  std::vector<uint32_t> loaded;  // four words for each element
  std::vector<uint32_t> stored;  // the written buffer
};

// One device and library for all formats of a number class.
class TypedRun {
 public:
  TypedRun(const char* backend, char number)
      : twin_(backend), library_(twin_.compile(typed_source(number), code_)) {
    RootSignatureDesc desc;
    desc.Parameters = {
        RootParameter::Table(
            {{.RangeType = DescriptorRangeType::kSrv, .NumDescriptors = 1, .BaseShaderRegister = 0},
             {.RangeType = DescriptorRangeType::kUav,
              .NumDescriptors = 1,
              .BaseShaderRegister = 1}}),
        RootParameter::Srv(1, 0), RootParameter::Uav(0, 0)};
    root_ = twin_.device.CreateRootSignature(desc).value();
    pipeline_ = twin_.device.CreateComputePipelineState({root_, library_, "", ""}).value();
  }

  TypedResults run(const ElementFormat& format, const std::vector<uint32_t>& bytes,
                   const std::vector<uint32_t>& values) {
    const Device& device = twin_.device;
    const Buffer source = CreateUploadBuffer(device, bytes).value();
    const Buffer input = CreateUploadBuffer(device, values).value();
    const Buffer results = twin_.output(kElements * 16);
    const Buffer target = twin_.output(kElements * 16 + 16);
    const DescriptorHeap heap =
        device
            .CreateDescriptorHeap(
                {DescriptorHeapType::kCbvSrvUav, 2, DescriptorHeapFlags::kShaderVisible, "typed"})
            .value();
    ShaderResourceViewDesc srv;
    srv.Format = format.format;
    srv.ViewDimension = SrvDimension::kBuffer;
    srv.Buffer.FirstElement = 1;
    srv.Buffer.NumElements = kViewed;
    device.CreateShaderResourceView(source, srv, heap.GetCPUDescriptorHandle(0)).value();
    UnorderedAccessViewDesc uav;
    uav.Format = format.format;
    uav.ViewDimension = UavDimension::kBuffer;
    uav.Buffer.FirstElement = 1;
    uav.Buffer.NumElements = kViewed;
    // A buffer that cannot be written stays null on both sides.
    static_cast<void>(
        device.CreateUnorderedAccessView(target, uav, heap.GetCPUDescriptorHandle(1)));
    CommandList list = device.CreateCommandList().value();
    list.SetDescriptorHeaps({heap});
    list.SetComputeRootSignature(root_);
    list.SetPipelineState(pipeline_);
    list.SetComputeRootDescriptorTable(0, heap.GetGPUDescriptorHandle(0));
    list.SetComputeRootShaderResourceView(1, input.GetGPUVirtualAddress());
    list.SetComputeRootUnorderedAccessView(2, results.GetGPUVirtualAddress());
    list.Dispatch(kElements / 64, 1, 1);
    twin_.queue.ExecuteAndWait(list).value();
    return {twin_.words(results), twin_.words(target)};
  }

 private:
  TwinDevice twin_;
  Compiled code_;
  ShaderLibrary library_;
  RootSignature root_;
  PipelineState pipeline_;
};

class VulkanTypedTwins : public testing::TestWithParam<char> {};

TEST_P(VulkanTypedTwins, EveryFormatIsReadAndWrittenAlike) {
  KAAMOS_NEED_VULKAN();
  TypedRun cpu("embree", GetParam()), vulkan("vulkan", GetParam());
  std::mt19937 random(1);
  std::vector<uint32_t> bytes(kElements * 4 + 4), values(kElements * 4);
  for (uint32_t& word : bytes) word = static_cast<uint32_t>(random());
  for (size_t i = 0; i < values.size(); ++i) {
    constexpr float kEdges[] = {0.0f,  -0.0f,    0.5f,      1.0f,  -1.0f,    1.5f,
                                -1.5f, INFINITY, -INFINITY, NAN,   65504.0f, 65520.0f,
                                1e-6f, 70000.0f, 1e30f,     -3e-8f};
    const auto bits = static_cast<uint32_t>(random());
    const float near = static_cast<float>(static_cast<int32_t>(bits)) / 0x1p31f;
    values[i] = i % 4 == 0          ? bits
                : i % 4 == 1        ? std::bit_cast<uint32_t>(kEdges[bits % 16])
                : GetParam() == 'f' ? std::bit_cast<uint32_t>(near)
                                    : bits >> bits % 32;
    // The driver decides whether denormal numbers are flushed to zero.
    if ((values[i] & 0x7F800000u) == 0 && GetParam() == 'f') values[i] = 0;
  }
  for (const ElementFormat& format : kElementFormats) {
    if (format.number != GetParam()) continue;
    const TypedResults expected = cpu.run(format, bytes, values);
    const TypedResults actual = vulkan.run(format, bytes, values);
    EXPECT_NE(expected.stored, std::vector<uint32_t>(expected.stored.size()));
    EXPECT_LT(std::count(expected.loaded.begin(), expected.loaded.end(), 0u), kElements * 7 / 2);
    const auto compare = [&](const char* what, const std::vector<uint32_t>& e,
                             const std::vector<uint32_t>& a) {
      size_t wrong = 0;
      std::string first;
      for (size_t i = 0; i < e.size(); ++i) {
        if (e[i] == a[i] || ++wrong > 3) continue;
        char line[128];
        std::snprintf(line, sizeof(line), "  word %zu: expected 0x%08x, is 0x%08x\n", i, e[i],
                      a[i]);
        first += line;
      }
      EXPECT_EQ(wrong, 0u) << what << " format " << static_cast<int>(format.format) << "\n"
                           << first;
    };
    compare("loads", expected.loaded, actual.loaded);
    compare("stores", expected.stored, actual.stored);
  }
}
INSTANTIATE_TEST_SUITE_P(Classes, VulkanTypedTwins, testing::Values('f', 'u', 'i'),
                         [](const auto& number) { return std::string(1, number.param); });

}  // namespace
}  // namespace kaamos::test
