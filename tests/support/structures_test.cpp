// SPDX-License-Identifier: MIT
#include "tests/support/harness.h"

namespace {

using namespace rtapi;
using namespace kaamos::support;
using BuildFlags = RaytracingAccelerationStructureBuildFlags;
using CopyMode = RaytracingAccelerationStructureCopyMode;
using InfoType = RaytracingAccelerationStructurePostbuildInfoType;

KAAMOS_CALLS(AccelerationStructures);

TEST_P(AccelerationStructures, Build_triangles) {
  const auto bottom = bottom_level(3);
  KAAMOS_SUPPORTED(bottom);
  EXPECT_EQ(trace({}, top_level(*bottom).value()),
            (std::vector<uint32_t>{104, 114, 124, 7, 7, 7, 7, 7}));
}

TEST_P(AccelerationStructures, Build_boxes) {
  KAAMOS_SUPPORTED(bottom_level(3, true));
}

TEST_P(AccelerationStructures, Build_update) {
  const auto built = bottom_level(2, false, BuildFlags::kAllowUpdate);
  KAAMOS_SUPPORTED(built);
  const auto updated =
      bottom_level(2, false, BuildFlags::kAllowUpdate | BuildFlags::kPerformUpdate, &*built, 1.0f);
  KAAMOS_SUPPORTED(updated);
  EXPECT_EQ(trace({}, top_level(*updated).value()),
            (std::vector<uint32_t>{7, 104, 114, 7, 7, 7, 7, 7}));
}

// A copy of `source`, or the backend's error.
#define KAAMOS_COPY(source, mode, bytes)                                               \
  const Buffer copy = buffer(bytes, ResourceStates::kRaytracingAccelerationStructure); \
  {                                                                                    \
    CommandList list = device_.CreateCommandList().value();                            \
    list.CopyRaytracingAccelerationStructure(copy.GetGPUVirtualAddress(),              \
                                             (source).GetGPUVirtualAddress(), mode);   \
    KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));                                     \
  }

TEST_P(AccelerationStructures, Copy_clone) {
  const Buffer built = bottom_level(2).value();
  KAAMOS_COPY(built, CopyMode::kClone, built.GetDesc().SizeInBytes);
  EXPECT_EQ(trace({}, top_level(copy).value())[1], 114u);
}

TEST_P(AccelerationStructures, Copy_compact) {
  const Buffer built = bottom_level(2, false, BuildFlags::kAllowCompaction).value();
  KAAMOS_COPY(built, CopyMode::kCompact, built.GetDesc().SizeInBytes);
  EXPECT_EQ(trace({}, top_level(copy).value())[1], 114u);
}

// `source` as bytes, sized by postbuild info and read by the host.
#define KAAMOS_BYTES(source, mode, info, bytes)                                         \
  std::vector<uint32_t> bytes;                                                          \
  {                                                                                     \
    const GpuVirtualAddress kaamos_source = (source).GetGPUVirtualAddress();            \
    const Buffer kaamos_size = buffer(16);                                              \
    CommandList kaamos_list = device_.CreateCommandList().value();                      \
    kaamos_list.EmitRaytracingAccelerationStructurePostbuildInfo(                       \
        {kaamos_size.GetGPUVirtualAddress(), info}, {&kaamos_source, 1});               \
    KAAMOS_SUPPORTED(queue_.ExecuteAndWait(kaamos_list));                               \
    const Buffer kaamos_copy = buffer(read(kaamos_size)[0]);                            \
    kaamos_list = device_.CreateCommandList().value();                                  \
    kaamos_list.CopyRaytracingAccelerationStructure(kaamos_copy.GetGPUVirtualAddress(), \
                                                    kaamos_source, mode);               \
    KAAMOS_SUPPORTED(queue_.ExecuteAndWait(kaamos_list));                               \
    bytes = read(kaamos_copy);                                                          \
  }

using SerializedHeader = SerializedRaytracingAccelerationStructureHeader;

SerializedHeader header_of(const std::vector<uint32_t>& bytes) {
  SerializedHeader header;
  std::memcpy(static_cast<void*>(&header), bytes.data(), sizeof(header));
  return header;
}

void patch(std::vector<uint32_t>& bytes, const Buffer& bottom_level) {
  const uint64_t address = bottom_level.GetGPUVirtualAddress();
  std::memcpy(&bytes[sizeof(SerializedHeader) / 4], &address, sizeof(address));
}

TEST_P(AccelerationStructures, Copy_serialize) {
  const Buffer built = bottom_level(2).value();
  KAAMOS_BYTES(built, CopyMode::kSerialize, InfoType::kSerialization, bytes);
  const SerializedHeader header = header_of(bytes);
  EXPECT_EQ(header.SerializedSizeInBytesIncludingHeader, bytes.size() * 4);
  EXPECT_LE(header.DeserializedSizeInBytes, built.GetDesc().SizeInBytes);
  EXPECT_EQ(header.NumBottomLevelAccelerationStructurePointersAfterHeader, 0u);
  EXPECT_EQ(
      device_.CheckDriverMatchingIdentifier(SerializedDataType::kRaytracingAccelerationStructure,
                                            header.DriverMatchingIdentifier),
      DriverMatchingIdentifierStatus::kCompatibleWithDevice);
}

// To another device of each backend; the top level comes before the bottom level that it refers to.
TEST_P(AccelerationStructures, Copy_deserialize) {
  const Buffer bottom = bottom_level(3, false, BuildFlags::kAllowUpdate).value();
  const Buffer top = top_level(bottom).value();
  KAAMOS_BYTES(bottom, CopyMode::kSerialize, InfoType::kSerialization, bottom_bytes);
  KAAMOS_BYTES(top, CopyMode::kSerialize, InfoType::kSerialization, top_bytes);
  ASSERT_EQ(header_of(top_bytes).NumBottomLevelAccelerationStructurePointersAfterHeader, 1u);
  const auto hits = trace({}, top);
  for (const char* backend : {"embree", "vulkan"}) {
    DeviceDesc desc;
    desc.Backend = backend;
    if (GetParam() != backend && !CreateDevice(desc).ok()) continue;
    keep_.clear();
    open(desc);
    const auto state = ResourceStates::kRaytracingAccelerationStructure;
    const Buffer new_bottom = buffer(header_of(bottom_bytes).DeserializedSizeInBytes, state);
    const Buffer new_top = buffer(header_of(top_bytes).DeserializedSizeInBytes, state);
    patch(top_bytes, new_bottom);
    const Buffer top_source = upload(top_bytes);
    const Buffer bottom_source = upload(bottom_bytes);
    CommandList list = device_.CreateCommandList().value();
    list.CopyRaytracingAccelerationStructure(
        new_top.GetGPUVirtualAddress(), top_source.GetGPUVirtualAddress(), CopyMode::kDeserialize);
    list.CopyRaytracingAccelerationStructure(new_bottom.GetGPUVirtualAddress(),
                                             bottom_source.GetGPUVirtualAddress(),
                                             CopyMode::kDeserialize);
    KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
    EXPECT_EQ(trace({}, new_top), hits) << GetParam() << " to " << backend;
    const auto updated = bottom_level(
        3, false, BuildFlags::kAllowUpdate | BuildFlags::kPerformUpdate, &new_bottom, 1.0f);
    ASSERT_TRUE(updated.ok()) << updated.error().message;
    EXPECT_EQ(trace({}, top_level(*updated).value()),
              (std::vector<uint32_t>{7, 104, 114, 124, 7, 7, 7, 7}));
    KAAMOS_BYTES(new_bottom, CopyMode::kSerialize, InfoType::kSerialization, again);
    EXPECT_EQ(again, bottom_bytes);
  }
}

TEST_P(AccelerationStructures, Copy_tools_visualization) {
  const Buffer built = bottom_level(2).value();
  KAAMOS_BYTES(built, CopyMode::kVisualizationDecodeForTools, InfoType::kToolsVisualization, bytes);
  BuildRaytracingAccelerationStructureToolsVisualizationHeader header;
  RaytracingGeometryDesc geometry;
  std::memcpy(static_cast<void*>(&header), bytes.data(), sizeof(header));
  std::memcpy(static_cast<void*>(&geometry), &bytes[sizeof(header) / 4], sizeof(geometry));
  ASSERT_EQ(header.NumDescs, 1u);
  EXPECT_EQ(geometry.Triangles.VertexCount, 6u);
  ASSERT_EQ(bytes.size() * 4, sizeof(header) + sizeof(geometry) + 6 * 12);
  float x;
  std::memcpy(&x, &bytes[(sizeof(header) + sizeof(geometry)) / 4], sizeof(x));
  EXPECT_EQ(x, -0.3f);
}

TEST_P(AccelerationStructures, EmitPostbuildInfo_compacted_size) {
  const Buffer built = bottom_level(2, false, BuildFlags::kAllowCompaction).value();
  const Buffer size = buffer(8);
  CommandList list = device_.CreateCommandList().value();
  const GpuVirtualAddress source = built.GetGPUVirtualAddress();
  list.EmitRaytracingAccelerationStructurePostbuildInfo(
      {size.GetGPUVirtualAddress(), InfoType::kCompactedSize}, {&source, 1});
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  EXPECT_GT(read(size)[0], 0u);
}

TEST_P(AccelerationStructures, EmitPostbuildInfo_current_size) {
  const Buffer built = bottom_level(2).value();
  const Buffer size = buffer(8);
  CommandList list = device_.CreateCommandList().value();
  const GpuVirtualAddress source = built.GetGPUVirtualAddress();
  list.EmitRaytracingAccelerationStructurePostbuildInfo(
      {size.GetGPUVirtualAddress(), InfoType::kCurrentSize}, {&source, 1});
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  EXPECT_GT(read(size)[0], 0u);
}

TEST_P(AccelerationStructures, GetPrebuildInfo) {
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kTopLevel;
  inputs.NumDescs = 100;
  const auto sizes = device_.GetRaytracingAccelerationStructurePrebuildInfo(inputs);
  KAAMOS_SUPPORTED(sizes);
  EXPECT_GT(sizes->ResultDataMaxSizeInBytes, 0u);
}

}  // namespace
