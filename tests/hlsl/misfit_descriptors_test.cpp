// SPDX-License-Identifier: MIT
//
// Neighbouring threads use descriptors that do not fit what the shader expects, on the CPU and on
// Vulkan: fitting ones are read, all others read zero and are not written, and nothing crashes.
// [D3D11.3 7.18]
#include <gtest/gtest.h>

#include <cstring>
#include <span>

#include "tests/vulkan/support.h"
#include "twin_device.h"

namespace kaamos::test {
namespace {

using namespace rtapi;

// Slots of the heap.
enum Slot : uint32_t {
  kImage,      // 4 x 4 floats, texel value 1
  kWideImage,  // 16 x 2 floats, texel value 2
  kNullSrv,
  kVolume,     // texel value 3
  kUintImage,  // texel value 4
  kRwImage,    // texel value 5
  kRawBuffer,
  kConstants,
  kUnwritten,
  kSlots,
};
constexpr uint32_t kThreads = 64;

constexpr const char* kSource = R"(
Texture2D<float4> images[] : register(t0, space1);
Texture3D<float4> volumes[] : register(t0, space2);
Texture2D<uint4> uint_images[] : register(t0, space3);
RWTexture2D<float4> rw_images[] : register(u0, space1);
SamplerState s : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")] [numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
  const uint i = NonUniformResourceIndex(id.x % 9);
  const uint at = id.x * 32;
  results.Store(at, (uint)images[i].Load(int3(1, 1, 0)).x);
  results.Store(at + 4, (uint)images[i].SampleLevel(s, float2(0.3, 0.3), 0).x);
  uint width, height, depth, levels;
  images[i].GetDimensions(0, width, height, levels);
  results.Store(at + 8, width * 100 + height * 10 + levels);
  results.Store(at + 12, (uint)volumes[i].Load(int4(0, 0, 1, 0)).x);
  results.Store(at + 16, uint_images[i].Load(int3(0, 0, 0)).x);
  results.Store(at + 20, (uint)rw_images[i][uint2(0, 0)].x);
  rw_images[i].GetDimensions(width, height);
  results.Store(at + 24, width * 10 + height);
  rw_images[i][uint2(1, 0)] = 7;
  AllMemoryBarrier();
  results.Store(at + 28, (uint)rw_images[i][uint2(1, 0)].x);
}
)";

Texture texture_of(TwinDevice& twin, ResourceDimension dimension, uint32_t width, uint32_t height,
                   Format format, uint32_t texel, ResourceFlags flags = ResourceFlags::kNone) {
  TextureDesc desc;
  desc.Dimension = dimension;
  desc.Width = width;
  desc.Height = height;
  desc.DepthOrArraySize = dimension == ResourceDimension::kTexture3D ? 2 : 1;
  desc.MipLevels = 1;
  desc.Format = format;
  desc.Flags = flags;
  const Texture texture = twin.device.CreateTexture(desc).value();
  const std::vector<uint32_t> data(size_t{width} * height * desc.DepthOrArraySize, texel);
  UploadTexture(twin.device, twin.queue, texture, 0, std::as_bytes(std::span(data))).value();
  return texture;
}

uint32_t bits(float value) {
  uint32_t out;
  std::memcpy(&out, &value, 4);
  return out;
}

std::vector<uint32_t> run(const char* backend) {
  TwinDevice twin(backend);
  const Device& device = twin.device;
  Compiled code;
  const ShaderLibrary library = twin.compile(kSource, code);
  if (!library) return {};
  const auto k2d = ResourceDimension::kTexture2D, k3d = ResourceDimension::kTexture3D;
  const Texture image = texture_of(twin, k2d, 4, 4, Format::kR32Float, bits(1));
  const Texture wide = texture_of(twin, k2d, 16, 2, Format::kR32Float, bits(2));
  const Texture volume = texture_of(twin, k3d, 2, 2, Format::kR32Float, bits(3));
  const Texture uint_image = texture_of(twin, k2d, 4, 4, Format::kR32Uint, 4);
  const Texture rw_image =
      texture_of(twin, k2d, 8, 4, Format::kR32Float, bits(5), ResourceFlags::kAllowUnorderedAccess);
  const Buffer words = CreateUploadBuffer(device, std::vector<uint32_t>(256, 6)).value();
  const DescriptorHeap heap =
      device
          .CreateDescriptorHeap({DescriptorHeapType::kCbvSrvUav, kSlots,
                                 DescriptorHeapFlags::kShaderVisible, "misfits"})
          .value();
  const auto srv = [&](Slot slot, const Texture& texture, Format format, SrvDimension dimension) {
    ShaderResourceViewDesc view;
    view.Format = format;
    view.ViewDimension = dimension;
    device.CreateShaderResourceView(texture, view, heap.GetCPUDescriptorHandle(slot)).value();
  };
  srv(kImage, image, Format::kR32Float, SrvDimension::kTexture2D);
  srv(kWideImage, wide, Format::kR32Float, SrvDimension::kTexture2D);
  ShaderResourceViewDesc null_view;
  null_view.Format = Format::kR32Float;
  null_view.ViewDimension = SrvDimension::kTexture2D;
  device.CreateShaderResourceView(Resource(), null_view, heap.GetCPUDescriptorHandle(kNullSrv))
      .value();
  srv(kVolume, volume, Format::kR32Float, SrvDimension::kTexture3D);
  srv(kUintImage, uint_image, Format::kR32Uint, SrvDimension::kTexture2D);
  UnorderedAccessViewDesc rw_view;
  rw_view.Format = Format::kR32Float;
  rw_view.ViewDimension = UavDimension::kTexture2D;
  device.CreateUnorderedAccessView(rw_image, rw_view, heap.GetCPUDescriptorHandle(kRwImage))
      .value();
  ShaderResourceViewDesc raw;
  raw.Format = Format::kR32Typeless;
  raw.ViewDimension = SrvDimension::kBuffer;
  raw.Buffer.NumElements = 256;
  raw.Buffer.Flags = BufferSrvFlags::kRaw;
  device.CreateShaderResourceView(words, raw, heap.GetCPUDescriptorHandle(kRawBuffer)).value();
  device
      .CreateConstantBufferView({words.GetGPUVirtualAddress(), 1024},
                                heap.GetCPUDescriptorHandle(kConstants))
      .value();
  RootSignatureDesc desc;
  const auto range = [](DescriptorRangeType type, uint32_t space) {
    DescriptorRange out;
    out.RangeType = type;
    out.NumDescriptors = kSlots;
    out.RegisterSpace = space;
    out.OffsetInDescriptorsFromTableStart = 0;
    return out;
  };
  desc.Parameters = {RootParameter::Table({range(DescriptorRangeType::kSrv, 1)}),
                     RootParameter::Table({range(DescriptorRangeType::kSrv, 2)}),
                     RootParameter::Table({range(DescriptorRangeType::kSrv, 3)}),
                     RootParameter::Table({range(DescriptorRangeType::kUav, 1)}),
                     RootParameter::Uav(0, 0)};
  StaticSamplerDesc sampler;
  sampler.Filter = Filter::kMinMagMipPoint;
  desc.StaticSamplers = {sampler};
  const RootSignature root = device.CreateRootSignature(desc).value();
  const Buffer results = twin.output(kThreads * 32);
  CommandList list = device.CreateCommandList().value();
  list.SetDescriptorHeaps({heap});
  list.SetComputeRootSignature(root);
  list.SetPipelineState(device.CreateComputePipelineState({root, library, "", ""}).value());
  for (uint32_t i = 0; i < 4; ++i) {
    list.SetComputeRootDescriptorTable(i, heap.GetGPUDescriptorHandle(0));
  }
  list.SetComputeRootUnorderedAccessView(4, results.GetGPUVirtualAddress());
  list.Dispatch(1, 1, 1);
  twin.queue.ExecuteAndWait(list).value();
  return twin.words(results);
}

void expect_zeros(const char* backend) {
  const std::vector<uint32_t> results = run(backend);
  ASSERT_EQ(results.size(), kThreads * 8);
  const std::vector<uint32_t> none(8);
  const std::vector<uint32_t> expected[kSlots] = {{1, 1, 441, 0, 0, 0, 0, 0},
                                                  {2, 2, 1621, 0, 0, 0, 0, 0},
                                                  none,
                                                  {0, 0, 0, 3, 0, 0, 0, 0},
                                                  {0, 0, 0, 0, 4, 0, 0, 0},
                                                  {0, 0, 0, 0, 0, 5, 84, 7},
                                                  none,
                                                  none,
                                                  none};
  for (uint32_t i = 0; i < kThreads; ++i) {
    const std::vector<uint32_t> is(results.begin() + i * 8, results.begin() + i * 8 + 8);
    EXPECT_EQ(is, expected[i % kSlots]) << "thread " << i << ", slot " << i % kSlots;
  }
}

TEST(VulkanMisfitDescriptors, ReadZeroAndAreNotWritten) {
  KAAMOS_NEED_VULKAN();
  expect_zeros("vulkan");
}

TEST(MisfitDescriptors, ReadZeroAndAreNotWrittenOnTheCpu) {
  expect_zeros("embree");
}

// ---------------------------------------------------------------------------------------------
// Root descriptors

constexpr const char* kRootSource = R"(
struct Item { uint a; float4 b; };
ByteAddressBuffer raw : register(t0);
StructuredBuffer<Item> items : register(t1);
cbuffer Constants : register(b0) { float4x4 transform; uint tail; };
RWByteAddressBuffer written : register(u1);
RWByteAddressBuffer results : register(u0);

[shader("compute")] [numthreads(8, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
  written.Store4(id.x * 16, uint4(1, 2, 3, 4));
  const Item item = items[id.x];
  uint old, count, stride;
  written.InterlockedAdd(4, 5, old);
  items.GetDimensions(count, stride);
  const uint4 sum = raw.Load4(id.x * 4) + uint4(item.a, asuint(item.b.xyz)) +
                    asuint(transform[id.x & 3]) + tail + written.Load(id.x * 16) + old + count +
                    (stride - 20);  // the type's
  results.Store(id.x * 4, 100 + sum.x + sum.y + sum.z + sum.w);
}
)";

void expect_null_root_descriptors_read_zero(const char* backend) {
  TwinDevice twin(backend);
  Compiled code;
  const ShaderLibrary library = twin.compile(kRootSource, code);
  ASSERT_TRUE(library);
  RootSignatureDesc desc;
  desc.Parameters = {RootParameter::Srv(0, 0), RootParameter::Srv(1, 0), RootParameter::Cbv(0, 0),
                     RootParameter::Uav(1, 0), RootParameter::Uav(0, 0)};
  const RootSignature root = twin.device.CreateRootSignature(desc).value();
  const Buffer results = twin.output(32);
  CommandList list = twin.device.CreateCommandList().value();
  list.SetComputeRootSignature(root);
  list.SetPipelineState(twin.device.CreateComputePipelineState({root, library, "", ""}).value());
  list.SetComputeRootShaderResourceView(0, 0);
  list.SetComputeRootShaderResourceView(1, 0);
  list.SetComputeRootConstantBufferView(2, 0);
  list.SetComputeRootUnorderedAccessView(3, 0);
  list.SetComputeRootUnorderedAccessView(4, results.GetGPUVirtualAddress());
  list.Dispatch(1, 1, 1);
  twin.queue.ExecuteAndWait(list).value();
  EXPECT_EQ(twin.words(results), std::vector<uint32_t>(8, 100));
}

TEST(VulkanMisfitDescriptors, NullRootDescriptorsReadZero) {
  KAAMOS_NEED_VULKAN();
  expect_null_root_descriptors_read_zero("vulkan");
}
TEST(MisfitDescriptors, NullRootDescriptorsReadZeroOnTheCpu) {
  expect_null_root_descriptors_read_zero("embree");
}

}  // namespace
}  // namespace kaamos::test
