// SPDX-License-Identifier: MIT
#include <cmath>

#include <kaamos/shader/abi.h>

#include "rtapi/testing/expect_error.h"
#include "rtapi/testing/null_backend.h"

namespace rtapi {
namespace {

namespace shader = kaamos::shader;
using testing::CreateNullDevice;
using testing::null_log;

class DescriptorTest : public ::testing::Test {
 protected:
  const shader::Descriptor& At(uint32_t i) {
    return *reinterpret_cast<const shader::Descriptor*>(heap_.GetCPUDescriptorHandle(i).ptr);
  }
  std::vector<Message> messages_;
  Device device_ =
      CreateNullDevice({.OnMessage = [this](const Message& m) { messages_.push_back(m); }});
  DescriptorHeap heap_ = device_.CreateDescriptorHeap({.NumDescriptors = 8}).value();
  CpuDescriptorHandle slot_ = heap_.GetCPUDescriptorHandleForHeapStart();
  Buffer buffer_ =
      device_
          .CreateBuffer(
              {.SizeInBytes = 1024, .Flags = ResourceFlags::kAllowUnorderedAccess, .Name = "data"})
          .value();
};

TEST_F(DescriptorTest, HeapsHaveHandles32BytesApart) {
  EXPECT_EQ(device_.GetDescriptorHandleIncrementSize(DescriptorHeapType::kSampler), 32u);
  EXPECT_EQ(heap_.GetCPUDescriptorHandle(3).ptr - slot_.ptr, 96u);
  EXPECT_EQ(heap_.GetGPUDescriptorHandleForHeapStart().ptr, 0u);
  auto visible = device_.CreateDescriptorHeap(
      {.NumDescriptors = 4, .Flags = DescriptorHeapFlags::kShaderVisible});
  EXPECT_NE(visible->GetGPUDescriptorHandleForHeapStart().ptr, 0u);
  for (uint32_t i = 0; i < 8; ++i) EXPECT_EQ(At(i).kind, shader::DescriptorKind::kNull);
}

TEST_F(DescriptorTest, HeapDescriptions) {
  EXPECT_ERROR(device_.CreateDescriptorHeap({.NumDescriptors = 0}), "KA0620");
  EXPECT_ERROR(device_.CreateDescriptorHeap({.NumDescriptors = 1'000'001}), "KA0620");
  EXPECT_ERROR(device_.CreateDescriptorHeap({.Type = DescriptorHeapType::kSampler,
                                             .NumDescriptors = 2049,
                                             .Flags = DescriptorHeapFlags::kShaderVisible}),
               "KA0620", "2048");
  EXPECT_ERROR(device_.CreateDescriptorHeap(
                   {.Type = static_cast<DescriptorHeapType>(4), .NumDescriptors = 1}),
               "KA0621");
  EXPECT_ERROR(device_.CreateDescriptorHeap(
                   {.NumDescriptors = 1, .Flags = static_cast<DescriptorHeapFlags>(2)}),
               "KA0621");
}

TEST_F(DescriptorTest, CountersOfStructuredBuffers) {
  const auto flags = ResourceFlags::kAllowUnorderedAccess;
  const Buffer counters =
      device_.CreateBuffer({.SizeInBytes = 8196, .Flags = flags, .Name = "counters"}).value();
  const auto uav = [&](const Buffer& counter, uint64_t offset, uint32_t stride = 16,
                       Format format = Format::kUnknown) {
    UnorderedAccessViewDesc desc{.Format = format, .ViewDimension = UavDimension::kBuffer};
    desc.Buffer.StructureByteStride = stride;
    desc.Buffer.CounterOffsetInBytes = offset;
    return device_.CreateUnorderedAccessView(buffer_, counter, desc, slot_);
  };
  ASSERT_EQ(testing::MessageOf(uav(counters, 8192)), "ok");
  EXPECT_EQ(shader::counter_address(At(0)), counters.GetGPUVirtualAddress() + 8192);
  EXPECT_EQ(shader::view_access(At(0)), shader::DescriptorAccess::kUnorderedAccess);
  EXPECT_EQ(At(0).stride_bytes, 16u);
  ASSERT_EQ(testing::MessageOf(uav(Buffer(), 0)), "ok");
  EXPECT_EQ(shader::counter_address(At(0)), 0u);
  EXPECT_ERROR(uav(counters, 4), "KA0634", "multiple of 4096", "\"counters\"", "8196");
  EXPECT_ERROR(uav(counters, 12288), "KA0634", "8196 bytes");
  EXPECT_ERROR(uav(counters, UINT64_MAX - 4095), "KA0634");
  EXPECT_ERROR(uav(Buffer(), 4096), "KA0634", "must be 0");
  EXPECT_ERROR(uav(counters, 0, 0, Format::kR32Float), "KA0634", "not structured");
  const Buffer plain = device_.CreateBuffer({.SizeInBytes = 64, .Name = "plain"}).value();
  EXPECT_ERROR(uav(plain, 0), "KA0634", "\"plain\"", "kAllowUnorderedAccess");
  const Buffer tiny = device_.CreateBuffer({.SizeInBytes = 3, .Flags = flags}).value();
  EXPECT_ERROR(uav(tiny, 0), "KA0634");
  const Buffer foreign =
      testing::CreateNullDevice().CreateBuffer({.SizeInBytes = 64, .Flags = flags}).value();
  EXPECT_ERROR(uav(foreign, 0), "KA0903");
}

TEST_F(DescriptorTest, ROOT_17_HandlesOutsideLiveHeapsAreErrors) {
  const ShaderResourceViewDesc desc = {.ViewDimension = SrvDimension::kBuffer,
                                       .Buffer = {.StructureByteStride = 16}};
  CpuDescriptorHandle dead;
  {
    auto heap = device_.CreateDescriptorHeap({.NumDescriptors = 1}).value();
    dead = heap.GetCPUDescriptorHandleForHeapStart();
  }
  for (CpuDescriptorHandle bad :
       {CpuDescriptorHandle{0}, dead, heap_.GetCPUDescriptorHandle(8),
        CpuDescriptorHandle{slot_.ptr + 8}, CpuDescriptorHandle{~size_t{0}}}) {
    EXPECT_ERROR(device_.CreateShaderResourceView(buffer_, desc, bad), "KA0622");
    EXPECT_ERROR(device_.CreateConstantBufferView({}, bad), "KA0622");
    EXPECT_ERROR(device_.CreateSampler({}, bad), "KA0622");
  }
  EXPECT_ERROR(device_.CreateSampler({}, slot_), "KA0622", "CBV/SRV/UAV");
  auto samplers =
      device_.CreateDescriptorHeap({.Type = DescriptorHeapType::kSampler, .NumDescriptors = 1});
  EXPECT_ERROR(device_.CreateShaderResourceView(buffer_, desc,
                                                samplers->GetCPUDescriptorHandleForHeapStart()),
               "KA0622", "sampler heap");
}

TEST_F(DescriptorTest, BufferViewsOfThreeKinds) {
  EXPECT_OK(device_.CreateShaderResourceView(
      buffer_,
      {.ViewDimension = SrvDimension::kBuffer,
       .Buffer = {.FirstElement = 2, .NumElements = 5, .StructureByteStride = 20}},
      slot_));
  EXPECT_EQ(At(0).kind, shader::DescriptorKind::kStructuredBuffer);
  EXPECT_EQ(At(0).address, buffer_.GetGPUVirtualAddress() + 40);
  EXPECT_EQ(At(0).size_bytes, 100u);
  EXPECT_EQ(At(0).stride_bytes, 20u);
  EXPECT_OK(device_.CreateUnorderedAccessView(
      buffer_,
      {.Format = Format::kR32Typeless,
       .ViewDimension = UavDimension::kBuffer,
       .Buffer = {.FirstElement = 4, .Flags = BufferUavFlags::kRaw}},
      slot_.Offset(1)));
  EXPECT_EQ(At(1).kind, shader::DescriptorKind::kRawBuffer);
  EXPECT_EQ(At(1).access, shader::DescriptorAccess::kUnorderedAccess);
  EXPECT_EQ(At(1).size_bytes, 1024u - 16);
  EXPECT_OK(device_.CreateShaderResourceView(
      buffer_, {.Format = Format::kR16G16Float, .ViewDimension = SrvDimension::kBuffer},
      slot_.Offset(2)));
  EXPECT_EQ(At(2).kind, shader::DescriptorKind::kTypedBuffer);
  EXPECT_EQ(At(2).format, static_cast<uint32_t>(Format::kR16G16Float));
  EXPECT_EQ(At(2).size_bytes, 1024u);
}

TEST_F(DescriptorTest, BufferViewErrors) {
  auto srv = [&](Format format, BufferSrv b) {
    return device_.CreateShaderResourceView(
        buffer_, {.Format = format, .ViewDimension = SrvDimension::kBuffer, .Buffer = b}, slot_);
  };
  const auto raw = BufferSrvFlags::kRaw;
  EXPECT_ERROR(srv(Format::kUnknown, {}), "KA0626", "StructureByteStride");
  EXPECT_ERROR(srv(Format::kR32Float, {.StructureByteStride = 4}), "KA0626");
  EXPECT_ERROR(srv(Format::kR32Float, {.Flags = raw}), "KA0626", "kR32Typeless");
  EXPECT_ERROR(srv(Format::kBC1Unorm, {}), "KA0626");
  EXPECT_ERROR(srv(Format::kUnknown, {.StructureByteStride = 7}), "KA0625", "7 bytes");
  for (const uint32_t stride : {2u, 6u, 10u, 26u}) {
    EXPECT_OK(srv(Format::kUnknown, {.StructureByteStride = stride}));
  }
  EXPECT_ERROR(srv(Format::kUnknown, {.StructureByteStride = 2052}), "KA0625");
  EXPECT_ERROR(srv(Format::kR32Typeless, {.FirstElement = 1, .Flags = raw}), "KA0625", "16");
  EXPECT_ERROR(srv(Format::kUnknown, {.NumElements = 65, .StructureByteStride = 16}), "KA0624",
               "0..65", "\"data\"", "64");
  EXPECT_ERROR(srv(Format::kUnknown,
                   {.FirstElement = UINT64_MAX, .NumElements = 2, .StructureByteStride = 16}),
               "KA0624");
  EXPECT_ERROR(device_.CreateUnorderedAccessView(
                   buffer_,
                   {.ViewDimension = UavDimension::kBuffer,
                    .Buffer = {.StructureByteStride = 4, .CounterOffsetInBytes = 4096}},
                   slot_),
               "KA0634", "4096");
  auto plain = device_.CreateBuffer({.SizeInBytes = 64, .Name = "plain"}).value();
  EXPECT_ERROR(
      device_.CreateUnorderedAccessView(
          plain, {.ViewDimension = UavDimension::kBuffer, .Buffer = {.StructureByteStride = 4}},
          slot_),
      "KA0627", "\"plain\"");
  EXPECT_ERROR(
      device_.CreateShaderResourceView(buffer_, {.ViewDimension = SrvDimension::kTexture2D}, slot_),
      "KA0623");
  EXPECT_ERROR(device_.CreateShaderResourceView(Resource(Buffer()),
                                                {.ViewDimension = SrvDimension::kBuffer}, slot_),
               "KA0904");
}

TEST_F(DescriptorTest, NullDescriptors) {
  EXPECT_OK(device_.CreateShaderResourceView(
      buffer_, {.ViewDimension = SrvDimension::kBuffer, .Buffer = {.StructureByteStride = 4}},
      slot_));
  EXPECT_OK(device_.CreateShaderResourceView(Resource(),
                                             {.ViewDimension = SrvDimension::kTexture2D}, slot_));
  EXPECT_EQ(At(0).kind, shader::DescriptorKind::kNull);
  EXPECT_OK(device_.CreateConstantBufferView({}, slot_));
  EXPECT_EQ(At(0).kind, shader::DescriptorKind::kNull);
}

TEST_F(DescriptorTest, ConstantBufferViews) {
  const uint64_t address = buffer_.GetGPUVirtualAddress();
  EXPECT_OK(device_.CreateConstantBufferView({address + 256, 512}, slot_));
  EXPECT_EQ(At(0).kind, shader::DescriptorKind::kConstantBuffer);
  EXPECT_EQ(At(0).size_bytes, 512u);
  EXPECT_ERROR(device_.CreateConstantBufferView({address + 4, 256}, slot_), "KA0628", "\"data\"");
  EXPECT_ERROR(device_.CreateConstantBufferView({address, 100}, slot_), "KA0628");
  EXPECT_ERROR(device_.CreateConstantBufferView({address, 0}, slot_), "KA0628");
  EXPECT_ERROR(device_.CreateConstantBufferView({0x100, 256}, slot_), "KA0628");
  // A view past the end is cut, with a warning.
  EXPECT_OK(device_.CreateConstantBufferView({address + 768, 512}, slot_));
  EXPECT_EQ(At(0).size_bytes, 256u);
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].Id.text(), "KA0826");
  EXPECT_EQ(messages_[0].Severity, MessageSeverity::kWarning);
}

TEST_F(DescriptorTest, ROOT_18_ERR_31_AccelerationStructureViews) {
  ShaderResourceViewDesc desc = {.ViewDimension = SrvDimension::kRaytracingAccelerationStructure};
  EXPECT_OK(device_.CreateShaderResourceView(Resource(), desc, slot_));
  EXPECT_EQ(At(0).kind, shader::DescriptorKind::kNull);
  desc.RaytracingAccelerationStructure.Location = buffer_.GetGPUVirtualAddress() + 256;
  EXPECT_OK(device_.CreateShaderResourceView(Resource(), desc, slot_));
  EXPECT_EQ(At(0).kind, shader::DescriptorKind::kAccelerationStructure);
  EXPECT_OK(device_.CreateShaderResourceView(buffer_, desc, slot_));  // the buffer is ignored
  EXPECT_EQ(At(0).address, buffer_.GetGPUVirtualAddress() + 256);
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].Id.text(), "KA0826");
  desc.RaytracingAccelerationStructure.Location += 128;
  EXPECT_ERROR(device_.CreateShaderResourceView(Resource(), desc, slot_), "KA0629", "256");
}

TEST_F(DescriptorTest, TextureViewsAreResolved) {
  auto cube = device_
                  .CreateTexture({.Width = 8,
                                  .Height = 8,
                                  .DepthOrArraySize = 12,
                                  .MipLevels = 0,
                                  .Format = Format::kR8G8B8A8Typeless,
                                  .Flags = ResourceFlags::kAllowUnorderedAccess})
                  .value();
  EXPECT_OK(device_.CreateShaderResourceView(
      cube,
      {.Format = Format::kR8G8B8A8UnormSrgb,
       .ViewDimension = SrvDimension::kTextureCubeArray,
       .TextureCubeArray = {.MostDetailedMip = 1, .First2DArrayFace = 6}},
      slot_));
  const auto& view = null_log().texture_views.back();
  EXPECT_EQ(view.first_mip, 1u);
  EXPECT_EQ(view.mip_count, 3u);
  EXPECT_EQ(view.first_slice, 6u);
  EXPECT_EQ(view.slice_count, 6u);
  EXPECT_EQ(At(0).kind, shader::DescriptorKind::kTexture);
  EXPECT_EQ(At(0).stride_bytes, static_cast<uint32_t>(SrvDimension::kTextureCubeArray));
  EXPECT_EQ(At(0).address, null_log().texture_views.size());
  EXPECT_EQ(At(0).format, static_cast<uint32_t>(Format::kR8G8B8A8UnormSrgb));
  EXPECT_OK(device_.CreateUnorderedAccessView(cube,
                                              {.Format = Format::kR8G8B8A8Uint,
                                               .ViewDimension = UavDimension::kTexture2DArray,
                                               .Texture2DArray = {.MipSlice = 2}},
                                              slot_));
  EXPECT_TRUE(null_log().texture_views.back().unordered_access);
  EXPECT_EQ(null_log().texture_views.back().slice_count, 12u);
}

TEST_F(DescriptorTest, TextureViewErrors) {
  auto texture = device_
                     .CreateTexture({.Width = 8,
                                     .Height = 4,
                                     .DepthOrArraySize = 6,
                                     .MipLevels = 2,
                                     .Format = Format::kR8G8B8A8Unorm,
                                     .Name = "t"})
                     .value();
  auto srv = [&](ShaderResourceViewDesc d) {
    return device_.CreateShaderResourceView(texture, d, slot_);
  };
  EXPECT_ERROR(srv({.ViewDimension = SrvDimension::kTexture3D}), "KA0623", "\"t\"");
  EXPECT_ERROR(srv({.ViewDimension = SrvDimension::kUnknown}), "KA0623");
  EXPECT_ERROR(srv({.ViewDimension = SrvDimension::kTextureCube}), "KA0630", "square");
  EXPECT_ERROR(
      srv({.ViewDimension = SrvDimension::kTexture2D, .Texture2D = {.MostDetailedMip = 2}}),
      "KA0630", "mip 2");
  EXPECT_ERROR(srv({.ViewDimension = SrvDimension::kTexture2D,
                    .Texture2D = {.MostDetailedMip = 1, .MipLevels = 2}}),
               "KA0630");
  EXPECT_ERROR(srv({.ViewDimension = SrvDimension::kTexture2DArray,
                    .Texture2DArray = {.FirstArraySlice = 5, .ArraySize = 2}}),
               "KA0630", "5..7");
  EXPECT_OK(srv({.Format = Format::kR8G8B8A8Uint, .ViewDimension = SrvDimension::kTexture2D}));
  EXPECT_ERROR(srv({.Format = Format::kR8G8B8A8Snorm, .ViewDimension = SrvDimension::kTexture2D}),
               "KA0626", "31", "28");
  EXPECT_ERROR(srv({.Format = Format::kR32Uint, .ViewDimension = SrvDimension::kTexture2D}),
               "KA0626", "42", "28");
  EXPECT_ERROR(srv({.ViewDimension = SrvDimension::kTexture2D, .Shader4ComponentMapping = 0x1687}),
               "KA0626", "component 7");
  EXPECT_ERROR(device_.CreateUnorderedAccessView(texture, slot_), "KA0627");
  const auto blocks = [&](Format own) {
    return device_.CreateTexture({.Width = 8, .Height = 8, .Format = own, .Name = "bc"}).value();
  };
  EXPECT_ERROR(device_.CreateUnorderedAccessView(blocks(Format::kBC7Unorm), slot_), "KA0570",
               "\"bc\"", "98");
  const auto cast = [&](Format own, Format seen) {
    return device_.CreateShaderResourceView(
        blocks(own), {.Format = seen, .ViewDimension = SrvDimension::kTexture2D}, slot_);
  };
  EXPECT_OK(cast(Format::kBC4Typeless, Format::kBC4Snorm));
  EXPECT_OK(cast(Format::kBC7Typeless, Format::kBC7UnormSrgb));
  EXPECT_OK(cast(Format::kBC7Unorm, Format::kBC7UnormSrgb));
  EXPECT_ERROR(cast(Format::kBC4Unorm, Format::kBC4Snorm), "KA0626", "81", "80");
  EXPECT_OK(cast(Format::kR32Sint, Format::kR32Uint));
  EXPECT_ERROR(cast(Format::kR32Uint, Format::kR32Float), "KA0626", "41", "42");
  EXPECT_ERROR(cast(Format::kR16G16Float, Format::kR16G16Unorm), "KA0626");
  EXPECT_ERROR(cast(Format::kBC7Typeless, Format::kBC3Unorm), "KA0626");
  EXPECT_ERROR(cast(Format::kBC1Typeless, Format::kR32G32Uint), "KA0626");
  EXPECT_OK(device_.CreateShaderResourceView(texture, slot_));
  EXPECT_EQ(null_log().texture_views.back().dimension, SrvDimension::kTexture2DArray);
}

TEST_F(DescriptorTest, SamplerErrors) {
  auto heap =
      device_.CreateDescriptorHeap({.Type = DescriptorHeapType::kSampler, .NumDescriptors = 1})
          .value();
  const auto slot = heap.GetCPUDescriptorHandleForHeapStart();
  EXPECT_OK(device_.CreateSampler({}, slot));
  EXPECT_ERROR(device_.CreateSampler({.Filter = static_cast<Filter>(0x40)}, slot), "KA0631");
  EXPECT_ERROR(device_.CreateSampler({.Filter = static_cast<Filter>(0x2)}, slot), "KA0631");
  EXPECT_ERROR(device_.CreateSampler({.MipLODBias = 16}, slot), "KA0631");
  EXPECT_ERROR(device_.CreateSampler({.MaxAnisotropy = 17}, slot), "KA0631", "17");
  EXPECT_ERROR(device_.CreateSampler({.MinLOD = std::nanf("")}, slot), "KA0631", "NaN");
  EXPECT_ERROR(device_.CreateSampler({.ComparisonFunc = static_cast<ComparisonFunc>(9)}, slot),
               "KA0631");
}

TEST_F(DescriptorTest, CopiesBetweenHeaps) {
  EXPECT_OK(device_.CreateConstantBufferView({buffer_.GetGPUVirtualAddress(), 256}, slot_));
  auto visible =
      device_
          .CreateDescriptorHeap({.NumDescriptors = 4, .Flags = DescriptorHeapFlags::kShaderVisible})
          .value();
  const auto views = DescriptorHeapType::kCbvSrvUav;
  const auto dest = visible.GetCPUDescriptorHandle(1);
  EXPECT_OK(device_.CopyDescriptorsSimple(3, dest, slot_, views));
  EXPECT_EQ(reinterpret_cast<const shader::Descriptor*>(dest.ptr)->kind,
            shader::DescriptorKind::kConstantBuffer);
  EXPECT_ERROR(device_.CopyDescriptorsSimple(4, dest, slot_, views), "KA0632", "3 from slot 1");
  EXPECT_ERROR(device_.CopyDescriptorsSimple(1, slot_, dest, views), "KA0632", "shader-visible");
  EXPECT_ERROR(device_.CopyDescriptorsSimple(1, dest, slot_, DescriptorHeapType::kSampler),
               "KA0632");
  EXPECT_ERROR(device_.CopyDescriptorsSimple(1, dest, {1}, views), "KA0622", "source");
  EXPECT_OK(device_.CopyDescriptorsSimple(0, {}, {}, views));
}

}  // namespace
}  // namespace rtapi
