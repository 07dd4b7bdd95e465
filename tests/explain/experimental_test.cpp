// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: an explanation of what DXR 2.0 adds: positions of triangles, and instances of
// partitioned top levels.
#include <gtest/gtest.h>
#include <rtapi/explain.h>
#include <rtapi/rtapi.h>
#include <rtapi/rtas_operations.h>
#include <rtapi/shader_compiler.h>
#include <rtapi/shader_table.h>
#include <rtapi/upload.h>

#include <cstring>
#include <vector>

namespace {

using namespace rtapi;

constexpr char kSource[] = R"(
RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer results : register(u0);
struct [raypayload] Corner {
  float3 position : write(closesthit) : read(caller);
  uint id : write(closesthit, miss) : read(caller);
};
[shader("raygeneration")]
void Generate() {
  const uint thread = DispatchRaysIndex().x;
  Corner corner = (Corner)0;
  RayDesc ray = {float3(10.0f * thread, 0, 0), 0, float3(0, 0, 1), 100};
  TraceRay(scene, 0, 0xff, 0, 0, 0, ray, corner);
  results.Store4(16 * thread, uint4(asuint(corner.position), corner.id));
}
[shader("closesthit")]
void Hit(inout Corner corner, BuiltInTriangleIntersectionAttributes attributes) {
  corner.position = TriangleObjectPositions().p1;
  corner.id = InstanceID();
}
[shader("miss")]
void Miss(inout Corner corner) { corner.id = 77; }
)";

ShaderLibrary compiled() {
  ShaderCompileOptions options;
  options.File = "positions.hlsl";
  options.Source = kSource;
  options.Target = "lib_6_10";
  options.Experimental = true;
  options.Interpret = true;
  options.Spirv = false;
  const ShaderCompilation out = CompileShaderLibrary(options);
  out.Status.value();
  return out.Library;
}

// A triangle at z = 5 in a slot of a partition that is moved by 20: rays at 0 and 10 miss, one at
// 20 hits.
class ExplainedPartitions : public testing::Test {
 protected:
  void SetUp() override {
    DeviceDesc desc;
    desc.ShaderModel = ShaderModel::k6_10;
    desc.IndirectRtasOperations = true;
    device_ = CreateDevice(desc).value();
    queue_ = device_.CreateCommandQueue().value();
    vertices_ =
        CreateUploadBuffer(device_, std::vector<float>{-1, -1, 5, 0, 2.5f, 5, 1, -1, 5}).value();
    RaytracingGeometryDesc triangle;
    triangle.Flags = RaytracingGeometryFlags::kOpaque;
    triangle.Triangles.VertexFormat = Format::kR32G32B32Float;
    triangle.Triangles.VertexCount = 3;
    triangle.Triangles.VertexBuffer = {vertices_.GetGPUVirtualAddress(), 12};
    bottom_ = BuildBottomLevel(device_, queue_, {triangle}, "triangle",
                               RaytracingAccelerationStructureBuildFlags::kAllowDataAccess)
                  .value();
    build_partitions();
    results_ = device_
                   .CreateBuffer({.SizeInBytes = 48,
                                  .Flags = ResourceFlags::kAllowUnorderedAccess,
                                  .InitialState = ResourceStates::kUnorderedAccess})
                   .value();
  }

  void build_partitions() {
    RtasPartitionedTlasInputsDesc inputs;
    inputs.Flags = RtasPartitionedTlasFlags::kEnablePartitionTranslation;
    inputs.InstanceCount = 4;
    inputs.MaxInstancePerPartitionCount = 4;
    inputs.PartitionCount = 2;
    RtasPartitionedTlasWriteInstanceArgs write;
    write.InstanceID = 0xABCDEF01;
    write.InstanceIndex = 3;
    write.PartitionIndex = 1;
    write.AccelerationStructure = bottom_.GetGPUVirtualAddress();
    RtasPartitionedTlasTranslatePartitionArgs move;
    move.PartitionIndex = 1;
    move.PartitionTranslation[0] = 20;
    const Buffer writes = CreateUploadBuffer(device_, std::vector{write}).value();
    const Buffer moves = CreateUploadBuffer(device_, std::vector{move}).value();
    const std::vector<RtasPartitionedTlasOperation> operations = {
        {RtasPartitionedTlasOperationType::kWriteInstance, 1, {writes.GetGPUVirtualAddress(), 0}},
        {RtasPartitionedTlasOperationType::kTranslatePartition,
         1,
         {moves.GetGPUVirtualAddress(), 0}}};
    const Buffer list_of_operations = CreateUploadBuffer(device_, operations).value();
    const Buffer count = CreateUploadBuffer(device_, std::vector<uint32_t>{2}).value();

    const RtasOperationInputs what = {RtasOperationType::kPartitionedTlas, &inputs};
    const RtasOperationPrebuildInfo sizes = device_.GetRTASOperationPrebuildInfo(what);
    scene_ = device_
                 .CreateBuffer({.SizeInBytes = sizes.ResultDataMaxSizeInBytes,
                                .Flags = ResourceFlags::kAllowUnorderedAccess,
                                .InitialState = ResourceStates::kRaytracingAccelerationStructure})
                 .value();
    const Buffer scratch = device_
                               .CreateBuffer({.SizeInBytes = sizes.ScratchDataSizeInBytes,
                                              .Flags = ResourceFlags::kAllowUnorderedAccess})
                               .value();
    RtasPartitionedTlasOperationData data;
    data.DestAccelerationStructureData = scene_.GetGPUVirtualAddress();
    data.ScratchAccelerationStructureData = scratch.GetGPUVirtualAddress();
    data.IndirectPartitionedTlasOpCount = count.GetGPUVirtualAddress();
    data.IndirectPartitionedTlasOps = list_of_operations.GetGPUVirtualAddress();
    const RtasOperationDesc operation = {&what, &data};
    CommandList list = device_.CreateCommandList().value();
    list.ExecuteIndirectRTASOperations({&operation, 1});
    queue_.ExecuteAndWait(list).value();
  }

  CommandList record() {
    const RootSignature root = device_.CreateRootSignature("SRV(t0), UAV(u0)").value();
    StateObjectDesc desc;
    desc.Add(DxilLibraryDesc{compiled(), {}});
    desc.Add(HitGroupDesc{.HitGroupExport = "Group", .ClosestHitShaderImport = "Hit"});
    desc.Add(RaytracingShaderConfig{16, 8});
    desc.Add(RaytracingPipelineConfig{1});
    desc.Add(GlobalRootSignature{root});
    pipeline_ = device_.CreateStateObject(desc).value();
    for (int i = 0; i < 3; ++i) tables_.emplace_back(pipeline_);
    tables_[0].AddRecord("Generate").value();
    tables_[1].AddRecord("Miss").value();
    tables_[2].AddRecord("Group").value();
    for (ShaderTable& table : tables_) table.Build(device_).value();
    CommandList list = device_.CreateCommandList().value();
    list.SetComputeRootSignature(root);
    list.SetPipelineState1(pipeline_);
    list.SetComputeRootShaderResourceView(0, scene_.GetGPUVirtualAddress());
    list.SetComputeRootUnorderedAccessView(1, results_.GetGPUVirtualAddress());
    list.DispatchRays({.RayGenerationShaderRecord = tables_[0].GetRecord(0),
                       .MissShaderTable = tables_[1].GetTable(),
                       .HitGroupTable = tables_[2].GetTable(),
                       .Width = 3});
    return list;
  }

  Device device_;
  CommandQueue queue_;
  Buffer vertices_, bottom_, scene_, results_;
  StateObject pipeline_;
  std::vector<ShaderTable> tables_;
};

TEST_F(ExplainedPartitions, ShowsTheInstanceWhereItsPartitionIsAndThePositionsThatAShaderRead) {
  CommandList list = record();
  const PixelExplanation explanation = ExplainPixel(queue_, list, {.X = 2}).value();
  const ExplainedCall& trace = explanation.RayGeneration.at(0).Calls.at(0);
  ASSERT_EQ(trace.Candidates.size(), 1u) << ToText(explanation);
  EXPECT_EQ(trace.Candidates[0].InstanceIndex, 3u);
  EXPECT_EQ(trace.Candidates[0].InstanceID, 0xABCDEF01u);
  EXPECT_EQ(trace.Candidates[0].Outcome, CandidateOutcome::kCommitted);
  EXPECT_FLOAT_EQ(trace.HitT, 5);
  const ExplainedShader& hit = trace.Shaders.at(0);
  EXPECT_EQ(hit.Name, "Hit");
  EXPECT_EQ(hit.After.at(0).Text, "0 2.5 5");  // in object space
  EXPECT_EQ(hit.After.at(1).Text, std::to_string(0xABCDEF01u));

  const auto bytes = ReadbackBuffer(device_, queue_, results_).value();
  uint32_t words[12];
  std::memcpy(words, bytes.data(), sizeof(words));
  EXPECT_EQ(words[3], 77u);
  EXPECT_EQ(words[7], 77u);
  EXPECT_EQ(words[11], 0xABCDEF01u);
}

TEST_F(ExplainedPartitions, ShowsAMissWhereThePartitionWas) {
  CommandList list = record();
  const PixelExplanation explanation = ExplainPixel(queue_, list, {.X = 0}).value();
  const ExplainedCall& trace = explanation.RayGeneration.at(0).Calls.at(0);
  EXPECT_FALSE(trace.Hit);
  EXPECT_EQ(trace.Shaders.at(0).Name, "Miss");
  EXPECT_EQ(trace.Shaders.at(0).After.at(1).Text, "77");
}

}  // namespace
