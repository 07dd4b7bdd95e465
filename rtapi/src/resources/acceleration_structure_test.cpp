// SPDX-License-Identifier: MIT
#include <algorithm>

#include "rtapi/testing/expect_error.h"
#include "rtapi/testing/null_backend.h"
#include "runtime/structures/serialized_identifier.h"

namespace rtapi {
namespace {

namespace runtime = kaamos::runtime;
using Flags = RaytracingAccelerationStructureBuildFlags;
using Type = RaytracingAccelerationStructureType;
using testing::CreateNullDevice;
using testing::MessageOf;

class BuildTest : public ::testing::Test {
 protected:
  BuildTest() {
    geometry_.Triangles.VertexFormat = Format::kR32G32B32Float;
    geometry_.Triangles.VertexCount = 30;
    geometry_.Triangles.VertexBuffer = {input_.GetGPUVirtualAddress(), 12};
    desc_.DestAccelerationStructureData = structure_.GetGPUVirtualAddress();
    desc_.ScratchAccelerationStructureData = scratch_.GetGPUVirtualAddress();
    desc_.Inputs.Type = Type::kBottomLevel;
    desc_.Inputs.NumDescs = 1;
    desc_.Inputs.pGeometryDescs = &geometry_;
  }
  Buffer Structure(uint64_t bytes) {
    return device_
        .CreateBuffer({.SizeInBytes = bytes,
                       .Flags = ResourceFlags::kAllowUnorderedAccess,
                       .InitialState = ResourceStates::kRaytracingAccelerationStructure,
                       .Name = "structure"})
        .value();
  }
  Status Build(std::vector<RaytracingAccelerationStructurePostbuildInfoDesc> infos = {}) {
    list_ = device_.CreateCommandList().value();
    list_.BuildRaytracingAccelerationStructure(desc_, infos);
    return list_.Close();
  }

  Device device_ = CreateNullDevice();
  Buffer input_ =
      device_.CreateBuffer({.SizeInBytes = 4096, .Heap = HeapType::kUpload, .Name = "input"})
          .value();
  Buffer structure_ = Structure(65536);
  Buffer scratch_ = device_
                        .CreateBuffer({.SizeInBytes = 4096,
                                       .Flags = ResourceFlags::kAllowUnorderedAccess,
                                       .Name = "scratch"})
                        .value();
  RaytracingGeometryDesc geometry_;
  BuildRaytracingAccelerationStructureDesc desc_;
  CommandList list_;
};

TEST_F(BuildTest, AS_03_DescriptionsAreCopiedWhenRecorded) {
  auto list = device_.CreateCommandList().value();
  {
    std::vector<RaytracingGeometryDesc> geometries(2, geometry_);
    desc_.Inputs.NumDescs = 2;
    desc_.Inputs.pGeometryDescs = geometries.data();
    list.BuildRaytracingAccelerationStructure(desc_);
    geometries[1].Triangles.VertexCount = 9999;
  }
  auto queue = device_.CreateCommandQueue().value();
  ASSERT_TRUE(queue.ExecuteAndWait(list).ok());
  const auto& command = std::get<runtime::BuildCommand>(testing::null_log().executed.at(0));
  ASSERT_EQ(command.geometries.size(), 2u);
  EXPECT_EQ(command.geometries[1].Triangles.VertexCount, 30u);
}

TEST_F(BuildTest, AS_02_ArrayOfPointers) {
  const RaytracingGeometryDesc* pointers[2] = {&geometry_, &geometry_};
  desc_.Inputs.DescsLayout = ElementsLayout::kArrayOfPointers;
  desc_.Inputs.NumDescs = 2;
  desc_.Inputs.ppGeometryDescs = pointers;
  EXPECT_OK(Build());
  pointers[1] = nullptr;
  EXPECT_ERROR(Build(), "KA0710", "geometry 1");
  desc_.Inputs.ppGeometryDescs = nullptr;
  EXPECT_ERROR(Build(), "KA0710");
}

TEST_F(BuildTest, AS_01_OneKindOfGeometry) {
  RaytracingGeometryDesc two[2] = {geometry_, {}};
  two[1].Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
  two[1].AABBs = {0, {0, 24}};
  desc_.Inputs.NumDescs = 2;
  desc_.Inputs.pGeometryDescs = two;
  EXPECT_ERROR(Build(), "KA0702", "geometry 1");
  two[1].Type = static_cast<RaytracingGeometryType>(3);
  EXPECT_ERROR(Build(), "KA0700", "type 3");
}

TEST_F(BuildTest, OneCallBuildsAndSaysWhatIsWrong) {
  const CommandQueue queue = device_.CreateCommandQueue().value();
  const std::vector<RaytracingGeometryDesc> geometries = {geometry_};
  const auto bottom = BuildBottomLevel(device_, queue, geometries, "floor");
  EXPECT_OK(bottom);
  EXPECT_EQ(bottom->name(), "floor");
  RaytracingInstanceDesc instance;
  instance.AccelerationStructure = bottom->GetGPUVirtualAddress();
  EXPECT_OK(BuildTopLevel(device_, queue, {instance}));
  EXPECT_OK(BuildTopLevel(device_, queue, std::vector<RaytracingInstanceDesc>()));
  EXPECT_ERROR(BuildBottomLevel(device_, CommandQueue(), geometries), "KA0904");
  EXPECT_ERROR(BuildBottomLevel(Device(), queue, geometries), "KA0904");
}

TEST_F(BuildTest, AS_06_Indices) {
  auto& t = geometry_.Triangles;
  t.IndexCount = 3;
  EXPECT_ERROR(Build(), "KA0704", "kUnknown");
  t.IndexFormat = Format::kR16Uint;
  EXPECT_ERROR(Build(), "KA0704", "no index buffer");
  t.IndexBuffer = input_.GetGPUVirtualAddress() + 1;
  EXPECT_ERROR(Build(), "KA0704", "multiple of 2");
  t.IndexBuffer = input_.GetGPUVirtualAddress() + 2;
  EXPECT_OK(Build());
  t.IndexFormat = Format::kR32Uint;
  EXPECT_ERROR(Build(), "KA0704", "multiple of 4");
  t.IndexFormat = Format::kR8Uint;
  EXPECT_ERROR(Build(), "KA0704", "62");
}

TEST_F(BuildTest, AS_09_VertexFormatsOfBothTiers) {
  struct Case {
    Format format;
    uint32_t stride;
    bool tier_1_0;
  };
  for (const Case& c : {Case{Format::kR32G32Float, 8, true},
                        {Format::kR32G32B32Float, 12, true},
                        {Format::kR16G16Float, 4, true},
                        {Format::kR16G16B16A16Float, 6, true},
                        {Format::kR16G16Snorm, 4, true},
                        {Format::kR16G16B16A16Snorm, 8, true},
                        {Format::kR16G16Unorm, 4, false},
                        {Format::kR16G16B16A16Unorm, 6, false},
                        {Format::kR10G10B10A2Unorm, 4, false},
                        {Format::kR8G8Unorm, 2, false},
                        {Format::kR8G8B8A8Unorm, 3, false},
                        {Format::kR8G8Snorm, 2, false},
                        {Format::kR8G8B8A8Snorm, 4, false}}) {
    geometry_.Triangles.VertexFormat = c.format;
    geometry_.Triangles.VertexBuffer.StrideInBytes = c.stride;
    EXPECT_OK(Build());
    Device old = CreateNullDevice({.Tier = RaytracingTier::kTier1_0});
    auto info = old.GetRaytracingAccelerationStructurePrebuildInfo(desc_.Inputs);
    EXPECT_EQ(info.ok(), c.tier_1_0) << MessageOf(info);
  }
  geometry_.Triangles.VertexFormat = Format::kR32G32B32A32Float;
  EXPECT_ERROR(Build(), "KA0703", "format 2");
}

TEST_F(BuildTest, AS_11_VertexAlignmentAndStride) {
  auto& v = geometry_.Triangles.VertexBuffer;
  v.StrideInBytes = 0x1'0000'000Cull;  // only the low half counts
  EXPECT_OK(Build());
  v.StrideInBytes = 13;
  EXPECT_ERROR(Build(), "KA0705", "13");
  v.StrideInBytes = 12;
  v.StartAddress += 2;
  EXPECT_ERROR(Build(), "KA0705", "multiple of 4");
  v.StartAddress -= 2;
  geometry_.Triangles.VertexFormat = Format::kR10G10B10A2Unorm;
  EXPECT_ERROR(Build(), "KA0705", "stride of 4");
}

TEST_F(BuildTest, AS_12_Transform) {
  geometry_.Triangles.Transform3x4 = input_.GetGPUVirtualAddress() + 8;
  EXPECT_ERROR(Build(), "KA0707", "16");
  geometry_.Triangles.Transform3x4 = input_.GetGPUVirtualAddress() + 16;
  EXPECT_OK(Build());
  geometry_.Triangles.Transform3x4 = input_.GetGPUVirtualAddress() + 4096 - 16;
  EXPECT_ERROR(Build(), "KA0719", "Transform3x4", "48 bytes");
}

TEST_F(BuildTest, AS_13_Aabbs) {
  geometry_ = {};
  geometry_.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
  geometry_.AABBs = {4, {input_.GetGPUVirtualAddress(), 0}};
  EXPECT_OK(Build());
  geometry_.AABBs.AABBs.StrideInBytes = 28;
  EXPECT_ERROR(Build(), "KA0708", "28");
  geometry_.AABBs.AABBs.StrideInBytes = 24;
  geometry_.AABBs.AABBs.StartAddress += 4;
  EXPECT_ERROR(Build(), "KA0708");
  geometry_.AABBs.AABBs.StartAddress -= 4;
  geometry_.AABBs.AABBCount = UINT64_MAX;
  EXPECT_ERROR(Build(), "KA0709", "2^29");
  geometry_.AABBs.AABBCount = 171;
  EXPECT_ERROR(Build(), "KA0719", "AABBs", "\"input\"");
}

TEST_F(BuildTest, AS_16_Limits) {
  geometry_.Triangles.VertexCount = 0xFFFFFFFFu;
  EXPECT_ERROR(Build(), "KA0709");
  desc_.Inputs.Type = Type::kTopLevel;
  desc_.Inputs.NumDescs = (1u << 24) + 1;
  EXPECT_ERROR(Build(), "KA0709", "2^24");
  desc_.Inputs.Type = Type::kBottomLevel;
  EXPECT_ERROR(Build(), "KA0709");
}

TEST_F(BuildTest, AS_15_NothingIsLegalInput) {
  desc_.Inputs.NumDescs = 0;
  desc_.Inputs.pGeometryDescs = nullptr;
  EXPECT_OK(Build());
  desc_.Inputs.Type = Type::kTopLevel;
  EXPECT_OK(Build());
}

TEST_F(BuildTest, InputsLieInLiveBuffers) {
  geometry_.Triangles.VertexCount = 342;  // 4104 bytes
  EXPECT_ERROR(Build(), "KA0719", "vertices", "\"input\"", "4104");
  geometry_.Triangles.VertexCount = 3;
  geometry_.Triangles.VertexBuffer.StartAddress = 0x1000;
  EXPECT_ERROR(Build(), "KA0712", "vertices", "no live buffer");
}

TEST_F(BuildTest, AS_14_Instances) {
  desc_.Inputs.Type = Type::kTopLevel;
  desc_.Inputs.NumDescs = 64;
  desc_.Inputs.InstanceDescs = input_.GetGPUVirtualAddress();
  EXPECT_OK(Build());
  desc_.Inputs.NumDescs = 65;
  EXPECT_ERROR(Build(), "KA0719", "instance descs");
  desc_.Inputs.NumDescs = 1;
  desc_.Inputs.InstanceDescs += 8;
  EXPECT_ERROR(Build(), "KA0717", "16");
  desc_.Inputs.DescsLayout = ElementsLayout::kArrayOfPointers;
  EXPECT_OK(Build());
  desc_.Inputs.InstanceDescs += 4;
  EXPECT_ERROR(Build(), "KA0717", "8");
  desc_.Inputs.DescsLayout = static_cast<ElementsLayout>(2);
  EXPECT_ERROR(Build(), "KA0700", "DescsLayout");
}

TEST_F(BuildTest, AS_20_Alignment) {
  desc_.DestAccelerationStructureData += 128;
  EXPECT_ERROR(Build(), "KA0711", "dest");
  desc_.DestAccelerationStructureData = 0;
  EXPECT_ERROR(Build(), "KA0711");
  desc_.DestAccelerationStructureData = structure_.GetGPUVirtualAddress();
  desc_.ScratchAccelerationStructureData += 128;
  EXPECT_ERROR(Build(), "KA0711", "scratch");
}

TEST_F(BuildTest, AS_21_DestinationMemory) {
  desc_.DestAccelerationStructureData = scratch_.GetGPUVirtualAddress();
  EXPECT_ERROR(Build(), "KA0713", "\"scratch\"", "kRaytracingAccelerationStructure");
  desc_.DestAccelerationStructureData = structure_.GetGPUVirtualAddress() + 65536 - 256;
  EXPECT_ERROR(Build(), "KA0719", "dest");
  desc_.DestAccelerationStructureData = structure_.GetGPUVirtualAddress();
  desc_.ScratchAccelerationStructureData = scratch_.GetGPUVirtualAddress() + 4096;
  EXPECT_ERROR(Build(), "KA0712", "scratch");
  auto plain = device_.CreateBuffer({.SizeInBytes = 4096, .Name = "plain"}).value();
  desc_.ScratchAccelerationStructureData = plain.GetGPUVirtualAddress();
  EXPECT_ERROR(Build(), "KA0713", "\"plain\"");
}

TEST_F(BuildTest, AS_46_PostbuildInfo) {
  using Info = RaytracingAccelerationStructurePostbuildInfoType;
  const uint64_t dest = scratch_.GetGPUVirtualAddress() + 1024;
  EXPECT_OK(Build({{dest, Info::kCompactedSize}, {dest + 8, Info::kSerialization}}));
  EXPECT_ERROR(Build({{dest, Info::kCurrentSize}, {dest + 8, Info::kCurrentSize}}), "KA0715",
               "twice");
  EXPECT_ERROR(Build({{dest + 4, Info::kCompactedSize}}), "KA0715", "8");
  EXPECT_ERROR(Build({{dest, static_cast<Info>(4)}}), "KA0715", "InfoType is 4");
  EXPECT_ERROR(Build({{input_.GetGPUVirtualAddress(), Info::kCompactedSize}}), "KA0715", "input");
  EXPECT_ERROR(Build({{scratch_.GetGPUVirtualAddress() + 4088, Info::kSerialization}}), "KA0719");
}

TEST_F(BuildTest, AS_46_EmitWritesOnePerSource) {
  const uint64_t source = structure_.GetGPUVirtualAddress();
  const uint64_t sources[3] = {source, source + 256, source};
  auto list = device_.CreateCommandList().value();
  list.EmitRaytracingAccelerationStructurePostbuildInfo(
      {scratch_.GetGPUVirtualAddress() + 4096 - 24, {}}, sources);
  EXPECT_OK(list.Close());
  ASSERT_TRUE(list.Reset().ok());
  list.EmitRaytracingAccelerationStructurePostbuildInfo(
      {scratch_.GetGPUVirtualAddress() + 4096 - 16, {}}, sources);
  EXPECT_ERROR(list.Close(), "KA0719");
  ASSERT_TRUE(list.Reset().ok());
  const uint64_t bad[1] = {source + 8};
  list.EmitRaytracingAccelerationStructurePostbuildInfo({scratch_.GetGPUVirtualAddress(), {}}, bad);
  EXPECT_ERROR(list.Close(), "KA0711", "source 0");
}

TEST_F(BuildTest, AS_50_FlagCombinations) {
  for (uint32_t bits = 0; bits < 64; ++bits) {
    desc_.Inputs.Flags = static_cast<Flags>(bits);
    const bool update = bits & 0x20;
    desc_.SourceAccelerationStructureData = update ? structure_.GetGPUVirtualAddress() : 0;
    if ((bits & 0xC) == 0xC) {
      EXPECT_ERROR(Build(), "KA0701", "kPreferFastTrace and kPreferFastBuild are both set");
    } else {
      EXPECT_OK(Build());
    }
  }
  desc_.Inputs.Flags = static_cast<Flags>(0x200);
  EXPECT_ERROR(Build(), "KA0700", "0x200");
  desc_.Inputs.Flags = Flags::kNone;
  desc_.Inputs.Type = static_cast<Type>(3);
  EXPECT_ERROR(Build(), "KA0700", "Type is 3");
}

// Triangles that are linked to a micromap array.
class LinkedBuildTest : public BuildTest {
 protected:
  LinkedBuildTest() {
    linkage_.OpacityMicromapArray = array_.GetGPUVirtualAddress();
    geometry_.Type = RaytracingGeometryType::kOmmTriangles;
    geometry_.OmmTriangles = {&triangles_, &linkage_};
  }

  Buffer array_ = Structure(4096);
  RaytracingGeometryTrianglesDesc triangles_ = geometry_.Triangles;
  RaytracingGeometryOmmLinkageDesc linkage_;
};

TEST_F(LinkedBuildTest, OMM_14_LinkedTrianglesAreTriangles) {
  EXPECT_OK(Build());
  triangles_.VertexFormat = Format::kR8Uint;
  EXPECT_ERROR(Build(), "KA0703", "geometry 0");
  geometry_.OmmTriangles.pTriangles = nullptr;
  EXPECT_ERROR(Build(), "KA0747", "pTriangles is null");
  geometry_.OmmTriangles = {&triangles_, nullptr};
  EXPECT_ERROR(Build(), "KA0747", "pOmmLinkage is null");
}

TEST_F(LinkedBuildTest, OMM_15_IndexFormats) {
  const uint64_t input = input_.GetGPUVirtualAddress();
  for (const auto& [format, bytes] :
       {std::pair(Format::kR8Uint, 1u), {Format::kR16Uint, 2u}, {Format::kR32Uint, 4u}}) {
    linkage_.OpacityMicromapIndexFormat = format;
    linkage_.OpacityMicromapIndexBuffer = {input, 8};
    EXPECT_OK(Build());
    if (bytes == 1) continue;
    linkage_.OpacityMicromapIndexBuffer = {input + 1, 8};
    EXPECT_ERROR(Build(), "KA0747", "multiple of " + std::to_string(bytes));
    linkage_.OpacityMicromapIndexBuffer = {input, 7};
    EXPECT_ERROR(Build(), "KA0747", "stride 7");
  }
  linkage_.OpacityMicromapIndexBuffer = {input, 1 << 20};
  EXPECT_ERROR(Build(), "KA0719", "geometry 0 micromap indices");
  linkage_.OpacityMicromapIndexFormat = Format::kR8G8Uint;
  EXPECT_ERROR(Build(), "KA0747", "index format");
  linkage_ = {};
  EXPECT_ERROR(Build(), "KA0747", "there must be a micromap array");
  linkage_.OpacityMicromapArray = array_.GetGPUVirtualAddress() + 64;
  EXPECT_ERROR(Build(), "KA0747", "multiple of 128");
  linkage_.OpacityMicromapArray = input & ~127ull;
  EXPECT_ERROR(Build(), "KA0713", "micromap array");
}

TEST_F(LinkedBuildTest, OMM_22_LinkageUpdatesGoWithUpdates) {
  desc_.Inputs.Flags = Flags::kAllowOmmLinkageUpdate;
  EXPECT_ERROR(Build(), "KA0747", "needs kAllowUpdate");
  desc_.Inputs.Flags = Flags::kAllowOmmUpdate | Flags::kAllowUpdate | Flags::kAllowDisableOmms;
  EXPECT_OK(Build());
}

TEST_F(BuildTest, OMM_01_MicromapArrays) {
  const RaytracingOpacityMicromapHistogramEntry entries[] = {
      {3, 0, RaytracingOpacityMicromapFormat::kOc1_2State},
      {2, 3, RaytracingOpacityMicromapFormat::kOc1_4State}};
  RaytracingOpacityMicromapArrayDesc array = {
      2, entries, input_.GetGPUVirtualAddress(), {input_.GetGPUVirtualAddress() + 1024, 8}};
  desc_.Inputs = {};
  desc_.Inputs.Type = Type::kOpacityMicromapArray;
  desc_.Inputs.NumDescs = 1;
  desc_.Inputs.pOpacityMicromapArrayDesc = &array;
  EXPECT_OK(Build());
  desc_.DestAccelerationStructureData += 128;
  EXPECT_OK(Build());
  desc_.DestAccelerationStructureData += 64;
  EXPECT_ERROR(Build(), "KA0711", "multiple of 128");
  desc_.DestAccelerationStructureData -= 64;
  desc_.Inputs.NumDescs = 2;
  EXPECT_ERROR(Build(), "KA0746", "NumDescs is 2");
  desc_.Inputs.NumDescs = 1;
  desc_.Inputs.DescsLayout = ElementsLayout::kArrayOfPointers;
  EXPECT_ERROR(Build(), "KA0746", "DescsLayout 1");
  desc_.Inputs.DescsLayout = ElementsLayout::kArray;
  for (const Flags flags : {Flags::kAllowUpdate, Flags::kMinimizeMemory, Flags::kAllowOmmUpdate,
                            Flags::kAllowDisableOmms}) {
    desc_.Inputs.Flags = flags;
    EXPECT_ERROR(Build(), "KA0746", "Flags are");
  }
  desc_.Inputs.Flags = Flags::kAllowCompaction | Flags::kPreferFastTrace;
  EXPECT_OK(Build());
  array.InputBuffer += 64;
  EXPECT_ERROR(Build(), "KA0746", "InputBuffer");
  array.InputBuffer -= 64;
  array.PerOmmDescs.StrideInBytes = 10;
  EXPECT_ERROR(Build(), "KA0746", "PerOmmDescs");
  array.PerOmmDescs.StrideInBytes = 4096;
  EXPECT_ERROR(Build(), "KA0719", "micromap descs");
  const RaytracingOpacityMicromapHistogramEntry deep = {
      1, 13, RaytracingOpacityMicromapFormat::kOc1_2State};
  array = {1, &deep, array.InputBuffer, {array.InputBuffer + 1024, 8}};
  EXPECT_ERROR(Build(), "KA0746", "subdivision level 13");
  array.pOmmHistogram = nullptr;
  EXPECT_ERROR(Build(), "KA0746", "pOmmHistogram is null");
}

TEST_F(BuildTest, TOP_12_DataAccess) {
  desc_.Inputs.Flags = Flags::kAllowDataAccess;
  EXPECT_ERROR(Build(), "KA0548", "needs shader model 6.10", "shader model 6.9");
  const Device device = CreateNullDevice({.ShaderModel = ShaderModel::k6_10});
  const auto size = [&] {
    return device.GetRaytracingAccelerationStructurePrebuildInfo(desc_.Inputs);
  };
  for (uint32_t bits = 0; bits < 32; ++bits) {
    if ((bits & 0xC) == 0xC) continue;
    desc_.Inputs.Flags = static_cast<Flags>(bits | 0x100);
    EXPECT_OK(size());
  }
  desc_.Inputs.Type = Type::kTopLevel;
  desc_.Inputs.Flags = Flags::kAllowDataAccess;
  EXPECT_ERROR(size(), "KA0548", "bottom levels only");
}

TEST_F(BuildTest, TIER_01_MicromapsNeedTier12) {
  const Device old = CreateNullDevice({.Tier = RaytracingTier::kTier1_1});
  BuildRaytracingAccelerationStructureInputs inputs = desc_.Inputs;
  const auto size = [&] { return old.GetRaytracingAccelerationStructurePrebuildInfo(inputs); };
  EXPECT_OK(size());
  inputs.Flags = Flags::kAllowDisableOmms;
  EXPECT_ERROR(size(), "KA0546", "build flag 0x80", "tier 1.1");
  inputs.Flags = Flags::kNone;
  const RaytracingGeometryTrianglesDesc triangles = geometry_.Triangles;
  const RaytracingGeometryOmmLinkageDesc linkage = {};
  geometry_.Type = RaytracingGeometryType::kOmmTriangles;
  geometry_.OmmTriangles = {&triangles, &linkage};
  EXPECT_ERROR(size(), "KA0546", "geometry 0 of type 2");
  inputs.Type = Type::kOpacityMicromapArray;
  EXPECT_ERROR(size(), "KA0546", "a micromap array");
}

TEST_F(BuildTest, AS_52_SourceGoesWithPerformUpdate) {
  desc_.SourceAccelerationStructureData = structure_.GetGPUVirtualAddress();
  EXPECT_ERROR(Build(), "KA0714", "kPerformUpdate");
  desc_.SourceAccelerationStructureData = 0;
  desc_.Inputs.Flags = Flags::kAllowUpdate | Flags::kPerformUpdate;
  EXPECT_ERROR(Build(), "KA0711", "source");
}

TEST_F(BuildTest, AS_40_PrebuildReadsNoGpuMemory) {
  geometry_.Triangles.VertexBuffer.StartAddress = 0xDEAD0000;
  geometry_.Triangles.Transform3x4 = 0xDEAD0010;
  EXPECT_OK(device_.GetRaytracingAccelerationStructurePrebuildInfo(desc_.Inputs));
  // Any number will do where an address is to come; a build needs the address.
  geometry_.Triangles.VertexBuffer.StartAddress = geometry_.Triangles.Transform3x4 = 1;
  geometry_.Triangles.IndexFormat = Format::kR32Uint;
  geometry_.Triangles.IndexCount = 30;
  geometry_.Triangles.IndexBuffer = 1;
  EXPECT_OK(device_.GetRaytracingAccelerationStructurePrebuildInfo(desc_.Inputs));
  EXPECT_ERROR(Build(), "KA0705", "0x1", "multiple of 4");
  geometry_.Triangles.VertexBuffer.StartAddress = input_.GetGPUVirtualAddress();
  EXPECT_ERROR(Build(), "KA0704", "0x1", "multiple of 4");
  geometry_.Triangles.IndexBuffer = 0;
  EXPECT_OK(device_.GetRaytracingAccelerationStructurePrebuildInfo(desc_.Inputs));
  EXPECT_ERROR(Build(), "KA0704", "no index buffer");
  geometry_.Triangles.IndexBuffer = input_.GetGPUVirtualAddress();
  EXPECT_ERROR(Build(), "KA0707", "0x1", "16");
  // Everything that is no address is checked.
  geometry_.Triangles.VertexBuffer.StrideInBytes = 13;
  EXPECT_ERROR(device_.GetRaytracingAccelerationStructurePrebuildInfo(desc_.Inputs), "KA0705",
               "13");
  geometry_ = {};
  geometry_.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
  geometry_.AABBs = {4, {1, 24}};
  EXPECT_OK(device_.GetRaytracingAccelerationStructurePrebuildInfo(desc_.Inputs));
  EXPECT_ERROR(Build(), "KA0708", "0x1");
  geometry_.AABBs.AABBs.StrideInBytes = 28;
  EXPECT_ERROR(device_.GetRaytracingAccelerationStructurePrebuildInfo(desc_.Inputs), "KA0708",
               "28");
}

TEST_F(BuildTest, AS_70_Copies) {
  using Mode = RaytracingAccelerationStructureCopyMode;
  const uint64_t source = structure_.GetGPUVirtualAddress();
  auto copy = [&](uint64_t dest, uint64_t from, Mode mode) {
    auto list = device_.CreateCommandList().value();
    list.CopyRaytracingAccelerationStructure(dest, from, mode);
    return list.Close();
  };
  EXPECT_OK(copy(source + 1024, source, Mode::kCompact));
  EXPECT_ERROR(copy(source, source, Mode::kClone), "KA0716", "overlap");
  EXPECT_ERROR(copy(source + 64, source, Mode::kClone), "KA0711", "dest");
  EXPECT_ERROR(copy(source, 0, Mode::kClone), "KA0711", "source");
  EXPECT_ERROR(copy(source, 0x100000, Mode::kClone), "KA0712");
  EXPECT_ERROR(copy(source + 1024, source, static_cast<Mode>(9)), "KA0716", "undefined");
}

TEST_F(BuildTest, AS_24_SerializedAndDecodedDataLieInPlainBuffers) {
  using Mode = RaytracingAccelerationStructureCopyMode;
  const uint64_t structure = structure_.GetGPUVirtualAddress();
  const uint64_t plain = scratch_.GetGPUVirtualAddress();
  const Buffer upload = device_.CreateBuffer({4096, HeapType::kUpload}).value();
  auto copy = [&](uint64_t dest, uint64_t from, Mode mode) {
    auto list = device_.CreateCommandList().value();
    list.CopyRaytracingAccelerationStructure(dest, from, mode);
    return list.Close();
  };
  for (const Mode mode : {Mode::kSerialize, Mode::kVisualizationDecodeForTools}) {
    EXPECT_OK(copy(plain, structure, mode));
    EXPECT_ERROR(copy(structure + 1024, structure, mode), "KA0713", "plain");
    EXPECT_ERROR(copy(upload.GetGPUVirtualAddress(), structure, mode), "KA0713",
                 "kAllowUnorderedAccess");
    EXPECT_ERROR(copy(plain + 128, structure, mode), "KA0711", "dest");
    EXPECT_ERROR(copy(plain, plain, mode), "KA0713", "source");
    EXPECT_ERROR(copy(0x100000, structure, mode), "KA0712", "dest");
  }
  EXPECT_OK(copy(structure, plain, Mode::kDeserialize));
  EXPECT_OK(copy(structure, upload.GetGPUVirtualAddress(), Mode::kDeserialize));
  EXPECT_ERROR(copy(plain, plain, Mode::kDeserialize), "KA0713", "dest");
  EXPECT_ERROR(copy(structure, structure + 1024, Mode::kDeserialize), "KA0713", "source");
  EXPECT_ERROR(copy(structure, plain + 8, Mode::kDeserialize), "KA0711", "source");
}

TEST_F(BuildTest, AS_75_IdentifiersOfSerializedData) {
  using MatchStatus = DriverMatchingIdentifierStatus;
  constexpr auto kType = SerializedDataType::kRaytracingAccelerationStructure;
  const auto own = kaamos::runtime::serialized_identifier();
  EXPECT_EQ(device_.CheckDriverMatchingIdentifier(kType, own), MatchStatus::kCompatibleWithDevice);
  EXPECT_EQ(device_.CheckDriverMatchingIdentifier(static_cast<SerializedDataType>(1), own),
            MatchStatus::kUnsupportedType);
  auto* bytes = reinterpret_cast<const uint8_t*>(&own);
  for (size_t i = 0; i < sizeof(own); ++i) {
    auto changed = own;
    reinterpret_cast<uint8_t*>(&changed)[i] = static_cast<uint8_t>(bytes[i] ^ 0x10);
    EXPECT_EQ(device_.CheckDriverMatchingIdentifier(kType, changed),
              i < sizeof(Guid) ? MatchStatus::kUnrecognized : MatchStatus::kIncompatibleVersion);
  }
  EXPECT_EQ(Device().CheckDriverMatchingIdentifier(kType, own), MatchStatus::kUnrecognized);
}

}  // namespace
}  // namespace rtapi
