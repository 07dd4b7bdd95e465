// SPDX-License-Identifier: MIT
//
// Devices, the error table, buffers, textures, footprints.
#include <set>

#include "rtapi/src/errors/error_table.h"
#include "rtapi/testing/expect_error.h"
#include "rtapi/testing/null_backend.h"

namespace rtapi {
namespace {

using testing::CreateNullDevice;
using testing::MessageOf;

TEST(ErrorTableTest, IdsAreSortedUniqueAndDescribed) {
  const auto table = detail::error_table();
  ASSERT_GT(table.size(), 90u);
  for (size_t i = 0; i < table.size(); ++i) {
    const uint32_t id = table[i].number;
    if (i > 0) {
      EXPECT_LT(table[i - 1].number, table[i].number);
    }
    EXPECT_TRUE((id >= 500 && id < 1000) || (id >= 2750 && id < 2800)) << id;
    EXPECT_NE(std::string(table[i].title), "");
    EXPECT_NE(std::string(table[i].cure), "");
    if (id < 1000) {
      EXPECT_NE(std::string(table[i].rule), "") << id;
    }
    const Error error = detail::make_error(static_cast<detail::Id>(table[i].number), "detail");
    EXPECT_EQ(error.code, table[i].code);
    EXPECT_EQ(error.message, error.id.text() + " " + table[i].title + ": detail");
  }
}

TEST(DeviceTest, IsListedAndChosenByName) {
  const Device device = CreateNullDevice();
  EXPECT_EQ(device.GetInfo().Backend, "null");
  std::set<std::string> names;
  for (const DeviceInfo& info : EnumerateDevices()) names.insert(info.Backend);
  EXPECT_TRUE(names.count("null"));
  EXPECT_ERROR(CreateDevice({.Backend = "voodoo"}), "KA0901", "\"voodoo\"", "\"null\"");
}

TEST(DeviceTest, TheFirstReasonForARemovalCounts) {
  EXPECT_ERROR(Device().RemoveDevice(), "KA0904");
  const Device device = CreateNullDevice();
  const CommandQueue queue = device.CreateCommandQueue().value();
  const Fence fence = device.CreateFence().value();
  EXPECT_TRUE(device.RemoveDevice().ok());
  EXPECT_TRUE(device.RemoveDevice().ok());
  EXPECT_ERROR(device.GetDeviceRemovedReason(), "KA0917");
  EXPECT_ERROR(device.CreateCommandQueue(), "KA0917");
  EXPECT_ERROR(fence.Wait(1), "KA0917");
  EXPECT_EQ(fence.GetCompletedValue(), UINT64_MAX);
}

TEST(DeviceTest, DescriptionIsChecked) {
  CreateNullDevice();
  EXPECT_ERROR(CreateDevice({.Backend = "null", .Threads = 5000}), "KA0914", "5000");
  EXPECT_ERROR(CreateDevice({.Backend = "null", .Precision = static_cast<TraversalPrecision>(9)}),
               "KA0914");
  EXPECT_ERROR(CreateDevice({.Backend = "null", .Tier = static_cast<RaytracingTier>(13)}), "KA0914",
               "13");
  EXPECT_ERROR(CreateDevice({.Backend = "null", .Tier = RaytracingTier::kTier2_0}), "KA0914",
               "Tier is 2.0; the highest that is offered is ");
  for (const uint32_t lanes : {1u, 2u, 3u, 5u, 64u}) {
    EXPECT_ERROR(CreateDevice({.Backend = "null", .WaveLanes = lanes}), "KA0914",
                 "WaveLanes is " + std::to_string(lanes));
  }
  for (const uint32_t lanes : {0u, 4u, 8u, 16u, 32u}) {
    EXPECT_TRUE(CreateDevice({.Backend = "null", .WaveLanes = lanes}).ok());
  }
}

TEST(DeviceTest, TierAndShaderModelFitEachOther) {
  CreateNullDevice();
  const auto create = [](RaytracingTier tier, ShaderModel model) {
    return CreateDevice({.Backend = "null", .Tier = tier, .ShaderModel = model});
  };
  for (uint32_t model = 0x60; model <= static_cast<uint32_t>(kExperimentalShaderModel); ++model) {
    const auto level = static_cast<ShaderModel>(model);
    EXPECT_TRUE(create(RaytracingTier::kNotSupported, level).ok());
    EXPECT_EQ(create(RaytracingTier::kTier1_0, level).ok(), model >= 0x63) << model;
    EXPECT_EQ(create(RaytracingTier::kTier1_1, level).ok(), model >= 0x65) << model;
    EXPECT_EQ(create(RaytracingTier::kTier1_2, level).ok(), model >= 0x69) << model;
  }
  EXPECT_ERROR(create(RaytracingTier::kTier1_1, ShaderModel::k6_4), "KA0914",
               "Tier 1.1 needs ShaderModel 6.5 or higher, but it is 6.4");
  EXPECT_ERROR(create(RaytracingTier::kTier1_1, static_cast<ShaderModel>(0x70)), "KA0914", "0x70");
  EXPECT_EQ(DeviceDesc().ShaderModel, ShaderModel::k6_9);  // 6.10 has to be asked for
  EXPECT_ERROR(create(RaytracingTier::kTier1_1, static_cast<ShaderModel>(0x51)), "KA0914", "0x51");
}

TEST(DeviceTest, TiersAndShaderModelsHaveNames) {
  for (const RaytracingTier tier :
       {RaytracingTier::kNotSupported, RaytracingTier::kTier1_0, RaytracingTier::kTier1_1,
        RaytracingTier::kTier1_2, RaytracingTier::kTier2_0}) {
    EXPECT_EQ(ParseRaytracingTier(GetName(tier)).value(), tier);
  }
  for (uint32_t model = 0x60; model <= 0x6A; ++model) {
    EXPECT_EQ(ParseShaderModel(GetName(static_cast<ShaderModel>(model))).value(),
              static_cast<ShaderModel>(model));
  }
  EXPECT_STREQ(GetName(RaytracingTier::kTier1_1), "1.1");
  EXPECT_EQ(GetName(ShaderModel::k6_5), "6.5");
  EXPECT_EQ(GetName(ShaderModel::k6_10), "6.10");
  EXPECT_EQ(GetName(static_cast<ShaderModel>(0x51)), "unknown");
  EXPECT_ERROR(ParseRaytracingTier("11"), "KA0914", "\"11\"", "none, 1.0, 1.1, 1.2, 2.0");
  EXPECT_ERROR(ParseShaderModel("6_6"), "KA0914", "\"6_6\"", "6.0 to 6.10");
}

TEST(DeviceTest, NoneOfRaytracingOnADeviceWithoutIt) {
  const Device device = CreateNullDevice({.Tier = RaytracingTier::kNotSupported});
  EXPECT_ERROR(device.GetRaytracingAccelerationStructurePrebuildInfo({}), "KA0545", "tier none");
  EXPECT_ERROR(
      device.CreateBuffer({.SizeInBytes = 256,
                           .Flags = ResourceFlags::kAllowUnorderedAccess,
                           .InitialState = ResourceStates::kRaytracingAccelerationStructure}),
      "KA0545");
  EXPECT_ERROR(device.CreateStateObject({}), "KA0545", "a state object");
  const auto heap = device.CreateDescriptorHeap({.NumDescriptors = 1}).value();
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kRaytracingAccelerationStructure;
  EXPECT_ERROR(
      device.CreateShaderResourceView(Resource(), view, heap.GetCPUDescriptorHandleForHeapStart()),
      "KA0545");
  CommandSignatureDesc rays;
  rays.ByteStride = sizeof(DispatchRaysDesc);
  rays.ArgumentDescs = {{.Type = IndirectArgumentType::kDispatchRays}};
  EXPECT_ERROR(device.CreateCommandSignature(rays), "KA0541", "tier none");
  EXPECT_TRUE(device.CreateBuffer({.SizeInBytes = 256}).ok());
}

TEST(DeviceTest, EmptyHandlesNeverCrash) {
  Device device;
  EXPECT_FALSE(device);
  EXPECT_ERROR(device.GetDeviceRemovedReason(), "KA0904");
  EXPECT_ERROR(device.CreateBuffer({}), "KA0904");
  EXPECT_ERROR(device.CreateTexture({}), "KA0904");
  EXPECT_ERROR(device.CreateDescriptorHeap({}), "KA0904");
  EXPECT_ERROR(device.CreateRootSignature(""), "KA0904");
  EXPECT_ERROR(device.CreateRootSignature(RootSignatureDesc{}), "KA0904");
  EXPECT_ERROR(device.CreateComputePipelineState({}), "KA0904");
  EXPECT_ERROR(device.CreateCommandList(), "KA0904");
  EXPECT_ERROR(device.CreateCommandQueue(), "KA0904");
  EXPECT_ERROR(device.CreateFence(), "KA0904");
  EXPECT_ERROR(device.CreateSampler({}, {}), "KA0904");
  EXPECT_ERROR(device.CreateConstantBufferView({}, {}), "KA0904");
  EXPECT_ERROR(device.CreateShaderResourceView(Resource(), {}, {}), "KA0904");
  EXPECT_ERROR(device.CreateUnorderedAccessView(Resource(), {}, {}), "KA0904");
  EXPECT_ERROR(device.CopyDescriptorsSimple(1, {}, {}, DescriptorHeapType::kSampler), "KA0904");
  EXPECT_ERROR(device.GetRaytracingAccelerationStructurePrebuildInfo({}), "KA0904");
  EXPECT_EQ(device.GetStatistics().TraceRayCalls, 0u);
  device.ResetStatistics();
  EXPECT_EQ(Buffer().GetGPUVirtualAddress(), 0u);
  EXPECT_ERROR(Buffer().Map(), "KA0904");
  EXPECT_EQ(Buffer().data<int>().size(), 0u);
  EXPECT_EQ(Texture().subresource_count(), 0u);
  EXPECT_EQ(DescriptorHeap().GetGPUDescriptorHandleForHeapStart().ptr, 0u);
  EXPECT_EQ(RootSignature().GetArgumentOffset(3), 0u);
  EXPECT_EQ(ShaderLibrary().GetExports().size(), 0u);
  EXPECT_EQ(PipelineState().name(), "");
}

class ResourceTest : public ::testing::Test {
 protected:
  Device device_ = CreateNullDevice();
};

TEST_F(ResourceTest, BuffersAreMappedAlignedAndZero) {
  auto buffer =
      device_.CreateBuffer({.SizeInBytes = 100, .Heap = HeapType::kUpload, .Name = "verts"});
  ASSERT_TRUE(buffer.ok()) << MessageOf(buffer);
  EXPECT_EQ(buffer->name(), "verts");
  EXPECT_EQ(buffer->GetGPUVirtualAddress() % 65536, 0u);
  ASSERT_EQ(buffer->Map().value().size(), 100u);
  for (std::byte b : *buffer->Map()) EXPECT_EQ(b, std::byte{0});
  EXPECT_EQ(buffer->data<float>().size(), 25u);
}

TEST_F(ResourceTest, BufferSizes) {
  EXPECT_ERROR(device_.CreateBuffer({.SizeInBytes = 0, .Name = "none"}), "KA0905", "\"none\"");
  EXPECT_ERROR(device_.CreateBuffer({.SizeInBytes = UINT64_MAX}), "KA0905");
  EXPECT_ERROR(device_.CreateBuffer({.SizeInBytes = uint64_t{1} << 40}), "KA0990");
}

TEST_F(ResourceTest, BufferHeapsFlagsAndStates) {
  EXPECT_ERROR(device_.CreateBuffer({.SizeInBytes = 1, .Heap = static_cast<HeapType>(0)}),
               "KA0906");
  EXPECT_ERROR(device_.CreateBuffer({.SizeInBytes = 1,
                                     .Heap = HeapType::kUpload,
                                     .Flags = ResourceFlags::kAllowUnorderedAccess}),
               "KA0906", "default heap");
  EXPECT_ERROR(device_.CreateBuffer({.SizeInBytes = 1, .Flags = static_cast<ResourceFlags>(0x40)}),
               "KA0906", "0x40");
  EXPECT_ERROR(device_.CreateBuffer({.SizeInBytes = 1,
                                     .Heap = HeapType::kReadback,
                                     .InitialState = ResourceStates::kGenericRead}),
               "KA0906");
  EXPECT_ERROR(device_.CreateBuffer({.SizeInBytes = 8}).value().Map(), "KA0911");
}

TEST_F(ResourceTest, AS_21_StructureBuffersNeedTheUavFlagOnTheDefaultHeap) {
  const auto state = ResourceStates::kRaytracingAccelerationStructure;
  const auto uav = ResourceFlags::kAllowUnorderedAccess;
  EXPECT_OK(device_.CreateBuffer({.SizeInBytes = 256, .Flags = uav, .InitialState = state}));
  EXPECT_ERROR(device_.CreateBuffer({.SizeInBytes = 256, .InitialState = state}), "KA0907",
               "kAllowUnorderedAccess");
  EXPECT_ERROR(
      device_.CreateBuffer({.SizeInBytes = 256, .Heap = HeapType::kUpload, .InitialState = state}),
      "KA0907", "default heap");
  EXPECT_ERROR(device_.CreateBuffer({.SizeInBytes = 256,
                                     .Flags = uav,
                                     .InitialState = state | ResourceStates::kUnorderedAccess}),
               "KA0907");
}

TEST_F(ResourceTest, TextureSizesAndFormats) {
  auto make = [&](ResourceDimension d, uint32_t w, uint32_t h, uint16_t n, uint16_t mips,
                  Format f = Format::kR8G8B8A8Unorm) {
    return device_.CreateTexture({.Dimension = d,
                                  .Width = w,
                                  .Height = h,
                                  .DepthOrArraySize = n,
                                  .MipLevels = mips,
                                  .Format = f});
  };
  const auto d2 = ResourceDimension::kTexture2D;
  EXPECT_OK(make(d2, 16384, 16384, 1, 1));
  EXPECT_ERROR(make(d2, 16385, 1, 1, 1), "KA0908", "16385", "16384");
  EXPECT_ERROR(make(d2, 1, 0, 1, 1), "KA0908");
  EXPECT_ERROR(make(d2, 1, 1, 2049, 1), "KA0908");
  EXPECT_ERROR(make(ResourceDimension::kTexture1D, 4, 2, 1, 1), "KA0908");
  EXPECT_ERROR(make(ResourceDimension::kTexture3D, 2049, 1, 1, 1), "KA0908");
  EXPECT_ERROR(make(ResourceDimension::kBuffer, 4, 4, 1, 1), "KA0908");
  EXPECT_ERROR(make(d2, 4, 4, 1, 4), "KA0908", "at most 3");
  EXPECT_ERROR(make(d2, 4, 4, 1, 1, Format::kD32Float), "KA0909", "40");
  EXPECT_ERROR(make(d2, 4, 4, 1, 1, Format::kUnknown), "KA0909");
  EXPECT_EQ(make(d2, 5, 3, 1, 0)->GetDesc().MipLevels, 3u);
  EXPECT_EQ(make(ResourceDimension::kTexture3D, 2, 2, 16, 0)->GetDesc().MipLevels, 5u);
  EXPECT_EQ(make(d2, 4, 4, 6, 0)->subresource_count(), 18u);
  EXPECT_EQ(make(ResourceDimension::kTexture3D, 4, 4, 6, 0)->subresource_count(), 3u);
}

TEST_F(ResourceTest, FootprintsAsD3D12LaysThemOut) {
  const TextureDesc desc = {.Width = 5,
                            .Height = 3,
                            .DepthOrArraySize = 2,
                            .MipLevels = 2,
                            .Format = Format::kR32G32B32A32Float};
  std::vector<PlacedSubresourceFootprint> layouts;
  std::vector<uint32_t> rows;
  std::vector<uint64_t> row_bytes;
  auto total = device_.GetCopyableFootprints(desc, 0, 4, 0, &layouts, &rows, &row_bytes);
  ASSERT_TRUE(total.ok()) << MessageOf(total);
  ASSERT_EQ(layouts.size(), 4u);
  EXPECT_EQ(layouts[0].Footprint.RowPitch, 256u);
  EXPECT_EQ(layouts[0].Footprint.Height, 3u);
  EXPECT_EQ(layouts[1].Offset, 1024u);  // 3 * 256, placed at a multiple of 512
  EXPECT_EQ(layouts[1].Footprint.Width, 2u);
  EXPECT_EQ(rows[1], 1u);
  EXPECT_EQ(row_bytes[1], 32u);
  EXPECT_EQ(layouts[2].Offset, 1536u);
  EXPECT_EQ(layouts[3].Offset, 2560u);
  EXPECT_EQ(*total, 2592u);
  EXPECT_ERROR(device_.GetCopyableFootprints(desc, 3, 2, 0, nullptr), "KA0817", "4");
  // The base offset is kept, and what follows is aligned relative to it.
  layouts.clear();
  EXPECT_EQ(device_.GetCopyableFootprints(desc, 1, 2, 7, &layouts).value(), 1280 - 256 + 80u);
  EXPECT_EQ(layouts[0].Offset, 7u);
  EXPECT_EQ(layouts[1].Offset, 519u);
}

// 20 x 10 texels of 16-byte blocks: 5 x 3 blocks, then 10 x 5 texels, 5 x 2, 2 x 1 and 1 x 1.
TEST_F(ResourceTest, FootprintsOfBlocksAreWholeBlocks) {
  const TextureDesc desc = {.Width = 20,
                            .Height = 10,
                            .DepthOrArraySize = 2,
                            .MipLevels = 0,
                            .Format = Format::kBC7Unorm};
  std::vector<PlacedSubresourceFootprint> layouts;
  std::vector<uint32_t> rows;
  std::vector<uint64_t> row_bytes;
  auto total = device_.GetCopyableFootprints(desc, 0, 6, 0, &layouts, &rows, &row_bytes);
  ASSERT_TRUE(total.ok()) << MessageOf(total);
  constexpr uint32_t kWidths[6] = {20, 12, 8, 4, 4, 20}, kHeights[6] = {12, 8, 4, 4, 4, 12};
  constexpr uint64_t kOffsets[6] = {0, 1024, 1536, 2048, 2560, 3072};
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(layouts[i].Offset, kOffsets[i]) << i;
    EXPECT_EQ(layouts[i].Footprint.Width, kWidths[i]) << i;
    EXPECT_EQ(layouts[i].Footprint.Height, kHeights[i]) << i;
    EXPECT_EQ(layouts[i].Footprint.RowPitch, 256u) << i;
    EXPECT_EQ(rows[i], kHeights[i] / 4) << i;
    EXPECT_EQ(row_bytes[i], kWidths[i] / 4 * 16) << i;
  }
  EXPECT_EQ(*total, 3072u + 2 * 256 + 5 * 16);
}

TEST_F(ResourceTest, BlocksHaveTwoOrThreeDimensionsAndNoUnorderedAccess) {
  int count = 0;
  for (uint32_t i = 0; i < 120; ++i) {
    const auto format = static_cast<Format>(i);
    const FormatInfo info = GetFormatInfo(format);
    if (info.block_side == 1) continue;
    ++count;
    EXPECT_EQ(info.block_side, 4);
    // BC1 and BC4.
    EXPECT_EQ(info.bytes, (i >= 70 && i <= 72) || (i >= 79 && i <= 81) ? 8 : 16) << i;
    TextureDesc desc = {.Width = 6, .Height = 3, .MipLevels = 0, .Format = format, .Name = "bc"};
    EXPECT_OK(device_.CreateTexture(desc));
    desc.Flags = ResourceFlags::kAllowUnorderedAccess;
    EXPECT_ERROR(device_.CreateTexture(desc), "KA0570", "\"bc\"", std::to_string(i));
    desc.Flags = ResourceFlags::kNone;
    desc.Dimension = ResourceDimension::kTexture3D;
    EXPECT_OK(device_.CreateTexture(desc));
    desc.Dimension = ResourceDimension::kTexture1D;
    desc.Height = 1;
    EXPECT_ERROR(device_.CreateTexture(desc), "KA0571", "kTexture1D");
  }
  EXPECT_EQ(count, 21);
}

TEST_F(ResourceTest, ForeignAndDeadAddressesAreNamed) {
  detail::Id id = detail::Id::kBuildAddress;
  EXPECT_EQ(detail::make_error(id, "x").id.text(), "KA0712");
  auto list = device_.CreateCommandList().value();
  uint64_t dead = 0;
  {
    auto buffer = device_.CreateBuffer({.SizeInBytes = 64}).value();
    dead = buffer.GetGPUVirtualAddress();
  }
  list.SetComputeRootSignature(device_.CreateRootSignature("SRV(t0)").value());
  list.SetComputeRootShaderResourceView(0, dead);
  EXPECT_ERROR(list.Close(), "KA0809", "no live buffer");
}

}  // namespace
}  // namespace rtapi
