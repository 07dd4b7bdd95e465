// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: indirect operations that depend on each other, clusters that a bottom level has no
// more, clusters that rays meet without permission, and what partitioned top levels refer to.
#include <rtapi/rtas_operations.h>

#include "tests/checks/world.h"

namespace kaamos::checks::test {
namespace {

using namespace rtapi;

// Memory and arguments of an operation with a single argument.
struct Operation {
  RtasOperationInputs inputs;
  RtasBatchedOperationData data;
  RtasOperationDesc desc() const {
    RtasOperationDesc desc;
    desc.pInputs = &inputs;
    desc.pBatchedOperationData = &data;
    return desc;
  }
};

class Clusters : public World {
 protected:
  DeviceDesc device_desc() const override {
    DeviceDesc desc;
    desc.ShaderModel = kExperimentalShaderModel;
    desc.IndirectRtasOperations = true;
    return desc;
  }
  void SetUp() override {
    World::SetUp();
    if (IsSkipped()) return;
    cluster_memory_ = buffer(4096, "clusters", true);
    level_memory_ = buffer(4096, "floor", true);
    triangles();  // for their vertices
    cluster_ = cluster(cluster_memory_);
    level_ = level(cluster_memory_);
    pipeline_ = make_pipeline("SRV(t0), UAV(u0)", RaytracingPipelineFlags::kAllowClusteredGeometry);
    set_ = make_tables(pipeline_);
  }
  template <class Args>
  void finish(Operation& operation, const Buffer& memory, const Args& args) {
    RtasBatchedOperationData& data = operation.data;
    data.BatchResultData = memory.GetGPUVirtualAddress();
    data.BatchScratchData = buffer(256, "scratch").GetGPUVirtualAddress();
    data.ResultAddressArray = {buffer(8, "addresses").GetGPUVirtualAddress(), 0};
    const std::vector<Args> all = {args};
    data.IndirectArgumentArray = {upload(all, "arguments").GetGPUVirtualAddress(), 0};
  }
  // The triangle of triangles().
  Operation cluster(const Buffer& memory, uint64_t micromaps = 0,
                    RtasClusterFlags flags = RtasClusterFlags::kNone) {
    clusters_desc_.Limits = {1, 0, 1, 1, 3, 1, 3, 0};
    Operation operation;
    operation.inputs.Type = RtasOperationType::kBuildClasFromTriangles;
    operation.inputs.pClusterTrianglesDesc = &clusters_desc_;
    RtasBuildClasFromTrianglesArgs args;
    args.TriangleCount = 1;
    args.VertexCount = 3;
    args.ClusterFlags = flags;
    args.OpacityMicromapArray = micromaps;
    args.BaseGeometryIndexAndFlags = kRtasClusteredGeometryOpaque;
    args.VertexBuffer = vertices_.GetGPUVirtualAddress();
    args.IndexBuffer = upload(std::vector<uint8_t>{0, 1, 2, 0}, "indices").GetGPUVirtualAddress();
    finish(operation, memory, args);
    return operation;
  }
  // Of the cluster at the beginning of a buffer.
  Operation level(const Buffer& of) {
    return level_at(upload(std::vector<uint64_t>{of.GetGPUVirtualAddress()}, "cluster list")
                        .GetGPUVirtualAddress());
  }
  // Of the cluster whose address is at this one.
  Operation level_at(uint64_t addresses) {
    level_desc_ = {RtasOperationFlags::kNone, 1, RtasOperationMode::kImplicitDestinations, 1, 1};
    Operation operation;
    operation.inputs.Type = RtasOperationType::kBuildBlasFromClas;
    operation.inputs.pClasDesc = &level_desc_;
    RtasBuildBlasFromClasArgs args;
    args.ClasAddressCount = 1;
    args.ClasAddressArray = addresses;
    finish(operation, level_memory_, args);
    return operation;
  }
  void run(const std::vector<RtasOperationDesc>& descs) {
    CommandList commands = list();
    commands.ExecuteIndirectRTASOperations(descs);
    const Status status = execute(commands);
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  void build_clustered_scene() {
    run({cluster_.desc()});
    run({level_.desc()});
    top_ = build(top_inputs({instance(level_memory_)}), "scene");
  }

  RtasClusterTrianglesInputsDesc clusters_desc_;
  RtasClasInputsDesc level_desc_;
  Buffer cluster_memory_, level_memory_;
  Operation cluster_, level_;
  TableSet set_;
};

TEST_P(Clusters, BuiltUsedAndTracedInThisOrderIsSilent) {
  build_clustered_scene();
  dispatch(set_.desc);
  expect_none();
}

TEST_P(Clusters, BuiltAndUsedByOneCall) {
  run({cluster_.desc(), level_.desc()});
  expect_one("KA0450", {"operation 1 reads cluster at byte 0 of buffer \"clusters\"",
                        "operation 0 of the same call writes result"});
  // Clusters that were there before are not the call's.
  run({level_.desc(), cluster_.desc()});
  expect_one("KA0450", {"operation 0 reads cluster", "operation 1 of the same call writes"});
  run({cluster_.desc()});
  run({level_.desc()});
  expect_none();
}

TEST_P(Clusters, AnArrayWrittenAndReadByOneCall) {
  clusters_desc_.Mode = RtasOperationMode::kGetSizes;
  cluster_.data.ResultSizeArray = {buffer(8, "sizes").GetGPUVirtualAddress(), 0};
  const Operation other = level_at(cluster_.data.ResultSizeArray.StartAddress);
  run({cluster_.desc(), other.desc()});
  expect_one("KA0450", {"operation 1 reads cluster addresses", "\"sizes\"",
                        "operation 0 of the same call writes result sizes"});
}

TEST_P(Clusters, TwoCallsWithoutABarrier) {
  CommandList commands = list();
  const RtasOperationDesc first = cluster_.desc();
  const RtasOperationDesc second = level_.desc();
  commands.ExecuteIndirectRTASOperations({&first, 1});
  commands.ExecuteIndirectRTASOperations({&second, 1});
  ASSERT_TRUE(execute(commands).ok());
  expect_one("KA0450", {"operation 0's cluster at byte 0 of buffer \"clusters\"",
                        "is written by ExecuteIndirectRTASOperations, command 0",
                        "(ExecuteIndirectRTASOperations, command 1)"});
  CommandList good = list();
  good.ExecuteIndirectRTASOperations({&first, 1});
  good.ResourceBarrier(ResourceBarrier::Uav(cluster_memory_));
  good.ExecuteIndirectRTASOperations({&second, 1});
  ASSERT_TRUE(execute(good).ok());
  expect_none();
}

TEST_P(Clusters, AddressesInTheStateInWhichTheyWereWritten) {
  level_ = level_at(cluster_.data.ResultAddressArray.StartAddress);
  CommandList commands = list();
  const RtasOperationDesc first = cluster_.desc();
  const RtasOperationDesc second = level_.desc();
  commands.ExecuteIndirectRTASOperations({&first, 1});
  commands.ResourceBarrier(ResourceBarrier::Uav());
  commands.ExecuteIndirectRTASOperations({&second, 1});
  ASSERT_TRUE(execute(commands).ok());
  expect_one("KA0451", {"operation 0's cluster addresses", "\"addresses\"", "kUnorderedAccess",
                        "kNonPixelShaderResource"});
}

TEST_P(Clusters, ReplacedAfterTheirBottomLevelWasBuilt) {
  build_clustered_scene();
  run({cluster_.desc()});
  dispatch(set_.desc);
  expect_one("KA0461", {"\"scene\"", "instance 0", "\"floor\"", "\"clusters\"",
                        "another one has been built there"});
  run({level_.desc()});
  top_ = build(top_inputs({instance(level_memory_)}), "scene");
  dispatch(set_.desc);
  expect_none();
}

TEST_P(Clusters, OverwrittenAfterTheirBottomLevelWasBuilt) {
  build_clustered_scene();
  copy_bytes(cluster_memory_, upload(std::vector<uint32_t>(4, 9u), "other bytes"));
  dispatch(set_.desc);
  expect_one("KA0461", {"\"clusters\"", "its bytes have been overwritten"});
}

TEST_P(Clusters, WithoutThePipelinesPermission) {
  build_clustered_scene();
  pipeline_ = make_pipeline();
  dispatch(make_tables(pipeline_).desc);
  expect_one("KA0496", {"\"floor\"", "kAllowClusteredGeometry"});
}

TEST_P(Clusters, WithoutTheQuerysPermission) {
  build_clustered_scene();
  query("Plain");
  expect_one("KA0496",
             {"\"Plain\"", "queries.hlsl:", "\"floor\"", "RAYQUERY_FLAG_ALLOW_CLUSTERED_GEOMETRY"});
  query("FromArray");
  expect_one("KA0496", {"\"FromArray\"", "\"floor\""});
  query("PlainRayGen");
  expect_one("KA0496", {"ray generation shader \"PlainRayGen\"", "\"floor\""});
  query("AllowsMicromaps");
  expect_one("KA0496", {"\"AllowsMicromaps\"", "\"floor\""});
}

TEST_P(Clusters, WhereAQueryNeedsNoPermission) {
  build_clustered_scene();
  for (const char* shader : {"AllowsClusters", "AllowsBoth", "SkipsTriangles"}) {
    query(shader);
    expect_none();
  }
  RaytracingInstanceDesc other = instance(level_memory_);
  other.InstanceMask = 1;
  top_ = build(top_inputs({other}), "scene");
  query("OtherMask");
  expect_none();
}

// Whatever the order, the one that reads is named. In one of them it finds no cluster.
TEST_P(Clusters, OperationsRunInAnyOrder) {
  constexpr int kCalls = 12;
  int readers_first = 0;
  for (int i = 0; i < kCalls; ++i) {
    const Buffer memory = buffer(4096, "new clusters", true);
    const Operation writer = cluster(memory);
    const Operation reader = level(memory);
    const std::vector<RtasOperationDesc> descs = {writer.desc(), reader.desc()};
    CommandList commands = list();
    for (int k = 0; k < i; ++k) commands.ResourceBarrier(ResourceBarrier::Uav());
    commands.ExecuteIndirectRTASOperations(descs);
    ASSERT_TRUE(execute(commands).ok());
    for (const Message& m : messages_) readers_first += m.Id.number == 788 ? 1 : 0;
    expect_one("KA0450", {"operation 1 reads cluster", "operation 0 of the same call writes"});
  }
  EXPECT_GT(readers_first, 0);
  EXPECT_LT(readers_first, kCalls);
}

// Partitioned top levels, which refer to bottom levels as of each instance's last write or update.
class Partitioned : public Clusters {
 protected:
  void SetUp() override {
    Clusters::SetUp();
    if (IsSkipped()) return;
    run({cluster_.desc()});
    run({level_.desc()});
    inputs_ = {RtasPartitionedTlasFlags::kNone, 4, 4, 1, 4};
    RtasOperationInputs inputs;
    inputs.pPartitionedTLASInputsDesc = &inputs_;
    const uint64_t bytes = device_.GetRTASOperationPrebuildInfo(inputs).ResultDataMaxSizeInBytes;
    top_ = buffer(bytes, "parts", true);
    scratch_ = buffer(256, "scratch");
  }
  template <class Args>
  void change(RtasPartitionedTlasOperationType type, const Args& args, bool in_place) {
    RtasPartitionedTlasOperation operation;
    operation.Type = type;
    operation.ArgCount = 1;
    operation.ArgData.StartAddress = upload(std::vector<Args>{args}, "args").GetGPUVirtualAddress();
    RtasPartitionedTlasOperationData data;
    data.SourceAccelerationStructureData = in_place ? top_.GetGPUVirtualAddress() : 0;
    data.DestAccelerationStructureData = top_.GetGPUVirtualAddress();
    data.ScratchAccelerationStructureData = scratch_.GetGPUVirtualAddress();
    data.IndirectPartitionedTlasOpCount =
        upload(std::vector<uint32_t>{1}, "count").GetGPUVirtualAddress();
    data.IndirectPartitionedTlasOps =
        upload(std::vector<RtasPartitionedTlasOperation>{operation}, "ops").GetGPUVirtualAddress();
    RtasOperationInputs inputs;
    inputs.pPartitionedTLASInputsDesc = &inputs_;
    RtasOperationDesc desc;
    desc.pInputs = &inputs;
    desc.pPartitionedTlasOperationData = &data;
    run({desc});
  }
  void write(uint32_t index, uint64_t level, bool in_place, uint32_t flags = 0) {
    RtasPartitionedTlasWriteInstanceArgs args;
    args.InstanceIndex = index;
    args.AccelerationStructure = level;
    args.InstanceFlags = static_cast<RtasPartitionedTlasInstanceFlags>(flags);
    change(RtasPartitionedTlasOperationType::kWriteInstance, args, in_place);
  }
  void update(uint32_t index, uint64_t level) {
    change(RtasPartitionedTlasOperationType::kUpdateInstance,
           RtasPartitionedTlasUpdateInstanceArgs{index, 0, level}, true);
  }
  uint64_t floor() const { return level_memory_.GetGPUVirtualAddress(); }

  RtasPartitionedTlasInputsDesc inputs_;
  Buffer scratch_;
};

TEST_P(Partitioned, TracedAsTheyAreIsSilent) {
  write(1, floor(), false);
  write(2, 0, true);
  dispatch(set_.desc);
  expect_none();
}

TEST_P(Partitioned, ABottomLevelThatIsBuiltAnew) {
  write(1, floor(), false);
  run({level_.desc()});
  dispatch(set_.desc);
  expect_one("KA0463", {"\"parts\"", "instance 1", "\"floor\"", "update the instance"});
  // Another instance's write does not help.
  write(2, 0, true);
  dispatch(set_.desc);
  expect_one("KA0463", {"instance 1", "\"floor\""});
  update(1, floor());
  dispatch(set_.desc);
  expect_none();
}

TEST_P(Partitioned, ABottomLevelThatIsGone) {
  write(0, floor(), false);
  copy_bytes(level_memory_, upload(std::vector<uint32_t>(4, 9u), "other bytes"));
  dispatch(set_.desc);
  expect_one("KA0461", {"\"parts\"", "instance 0", "\"floor\"", "overwritten"});
}

TEST_P(Partitioned, ClustersThatAreOthersNow) {
  write(0, floor(), false);
  run({cluster_.desc()});
  dispatch(set_.desc);
  expect_one("KA0461", {"\"parts\"", "instance 0", "\"floor\"", "\"clusters\""});
}

TEST_P(Partitioned, WithoutThePipelinesPermissionForClusters) {
  write(0, floor(), false);
  pipeline_ = make_pipeline();
  dispatch(make_tables(pipeline_).desc);
  expect_one("KA0496", {"\"floor\"", "kAllowClusteredGeometry"});
}

TEST_P(Partitioned, ARecordThatIsMissing) {
  RtasPartitionedTlasWriteInstanceArgs args;
  args.AccelerationStructure = build(bottom_inputs(triangles()), "plain").GetGPUVirtualAddress();
  args.InstanceContributionToHitGroupIndex = 5;
  change(RtasPartitionedTlasOperationType::kWriteInstance, args, false);
  dispatch(set_.desc);
  expect_one("KA0430", {"record 5", "instance 0"});
}

// Clusters with opacity micromaps.
class LinkedClusters : public Clusters {
 protected:
  void SetUp() override {
    Clusters::SetUp();
    if (IsSkipped()) return;
    one_ = {1, 0, RaytracingOpacityMicromapFormat::kOc1_4State};
    array_.NumOmmHistogramEntries = 1;
    array_.pOmmHistogram = &one_;
    array_.InputBuffer = upload(std::vector<uint32_t>(64), "states").GetGPUVirtualAddress();
    const std::vector<RaytracingOpacityMicromapDesc> descs = {{0, 0, 2}};
    array_.PerOmmDescs = {upload(descs, "descs").GetGPUVirtualAddress(), 8};
    micromap_inputs_.Type = RaytracingAccelerationStructureType::kOpacityMicromapArray;
    micromap_inputs_.NumDescs = 1;
    micromap_inputs_.pOpacityMicromapArrayDesc = &array_;
    micromaps_ = build(micromap_inputs_, "micromaps");
    using Flags = RaytracingPipelineFlags;
    pipeline_ = make_pipeline("SRV(t0), UAV(u0)",
                              Flags::kAllowClusteredGeometry | Flags::kAllowOpacityMicromaps);
    set_ = make_tables(pipeline_);
  }
  void build_linked(RtasClusterFlags flags, uint32_t instance_flags) {
    cluster_ = cluster(cluster_memory_, micromaps_.GetGPUVirtualAddress(), flags);
    clusters_desc_.Flags = RtasOperationFlags::kAllowOmm;
    clusters_desc_.Limits.MaxOpacityMicromapIndicesPerCluster = 1;
    run({cluster_.desc()});
    level_desc_.Flags = RtasOperationFlags::kAllowOmm;
    run({level_.desc()});
    RaytracingInstanceDesc desc = instance(level_memory_);
    desc.Flags = instance_flags;
    top_ = build(top_inputs({desc}), "scene");
  }

  RaytracingOpacityMicromapHistogramEntry one_;
  RaytracingOpacityMicromapArrayDesc array_;
  BuildRaytracingAccelerationStructureInputs micromap_inputs_;
  Buffer micromaps_;
};

TEST_P(LinkedClusters, DisabledWithoutTheirPermission) {
  build_linked(RtasClusterFlags::kAllowDisableOmms, 0x20);
  dispatch(set_.desc);
  expect_none();
  build_linked(RtasClusterFlags::kNone, 0x20);
  dispatch(set_.desc);
  expect_one("KA0494", {"instance 0", "\"floor\"", "clusters", "kAllowDisableOmms"});
}

TEST_P(LinkedClusters, WithoutThePipelinesPermission) {
  build_linked(RtasClusterFlags::kNone, 0);
  pipeline_ = make_pipeline("SRV(t0), UAV(u0)", RaytracingPipelineFlags::kAllowClusteredGeometry);
  dispatch(make_tables(pipeline_).desc);
  expect_one("KA0493", {"\"floor\"", "kAllowOpacityMicromaps"});
  query("AllowsClusters");
  expect_one("KA0493", {"\"floor\"", "RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS"});
}

TEST_P(LinkedClusters, ReplacedMicromaps) {
  build_linked(RtasClusterFlags::kNone, 0);
  CommandList again = list();
  record_build(again, micromaps_, micromap_inputs_);
  ASSERT_TRUE(execute(again).ok());
  dispatch(set_.desc);
  expect_one("KA0495", {"\"floor\"", "\"micromaps\"", "Build the cluster"});
}

INSTANTIATE_TEST_SUITE_P(Embree, Partitioned, ::testing::Values("embree"));
INSTANTIATE_TEST_SUITE_P(Vulkan, Partitioned, ::testing::Values("vulkan"));
INSTANTIATE_TEST_SUITE_P(Embree, LinkedClusters, ::testing::Values("embree"));
INSTANTIATE_TEST_SUITE_P(Vulkan, LinkedClusters, ::testing::Values("vulkan"));
INSTANTIATE_TEST_SUITE_P(Embree, Clusters, ::testing::Values("embree"));
INSTANTIATE_TEST_SUITE_P(Vulkan, Clusters, ::testing::Values("vulkan"));

}  // namespace
}  // namespace kaamos::checks::test
