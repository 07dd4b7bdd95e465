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

// A copy of `source`, or what the backend says.
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

TEST_P(AccelerationStructures, Copy_serialize) {
  const Buffer built = bottom_level(2).value();
  KAAMOS_COPY(built, CopyMode::kSerialize, built.GetDesc().SizeInBytes + 65536);
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
