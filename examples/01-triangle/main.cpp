// SPDX-License-Identifier: MIT
// One triangle, with every call written out: vertex buffer, bottom level, top level, hit group,
// three shader tables.
#include <shaders/triangle.h>

#include <algorithm>

#include "../common/example.h"

using namespace rtapi;

// Memory for an acceleration structure. Such a buffer stays in its one state for its whole life.
static Buffer CreateAccelerationStructureBuffer(const Device& device, uint64_t bytes,
                                                const char* name) {
  return device
      .CreateBuffer({.SizeInBytes = bytes,
                     .Flags = ResourceFlags::kAllowUnorderedAccess,
                     .InitialState = ResourceStates::kRaytracingAccelerationStructure,
                     .Name = name})
      .value();
}

static Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const example::Image image = example::CreateImage(setup);

  // The bottom level: one opaque triangle of three float3 vertices, no index buffer.
  const std::vector<float> vertices = {0.0f, 0.7f, 0.0f, 0.8f, -0.6f, 0.0f, -0.8f, -0.6f, 0.0f};
  const Buffer vertex_buffer = CreateUploadBuffer(device, vertices, "vertices").value();
  RaytracingGeometryDesc geometry;
  geometry.Type = RaytracingGeometryType::kTriangles;
  geometry.Flags = RaytracingGeometryFlags::kOpaque;
  geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  geometry.Triangles.VertexCount = 3;
  geometry.Triangles.VertexBuffer = {vertex_buffer.GetGPUVirtualAddress(), 12};
  BuildRaytracingAccelerationStructureInputs bottom;
  bottom.Type = RaytracingAccelerationStructureType::kBottomLevel;
  bottom.Flags = RaytracingAccelerationStructureBuildFlags::kPreferFastTrace;
  bottom.NumDescs = 1;
  bottom.pGeometryDescs = &geometry;
  const auto bottom_size = device.GetRaytracingAccelerationStructurePrebuildInfo(bottom).value();
  const Buffer bottom_level = CreateAccelerationStructureBuffer(
      device, bottom_size.ResultDataMaxSizeInBytes, "bottom level");

  // The top level: one instance, 64 bytes in GPU memory.
  RaytracingInstanceDesc instance;  // identity transform, mask 0xFF
  instance.AccelerationStructure = bottom_level.GetGPUVirtualAddress();
  const Buffer instances =
      CreateUploadBuffer(device, std::vector<RaytracingInstanceDesc>{instance}, "instances")
          .value();
  BuildRaytracingAccelerationStructureInputs top;
  top.Type = RaytracingAccelerationStructureType::kTopLevel;
  top.Flags = RaytracingAccelerationStructureBuildFlags::kPreferFastTrace;
  top.NumDescs = 1;
  top.InstanceDescs = instances.GetGPUVirtualAddress();
  const auto top_size = device.GetRaytracingAccelerationStructurePrebuildInfo(top).value();
  const Buffer top_level =
      CreateAccelerationStructureBuffer(device, top_size.ResultDataMaxSizeInBytes, "top level");
  const Buffer scratch =
      device
          .CreateBuffer({.SizeInBytes = std::max(bottom_size.ScratchDataSizeInBytes,
                                                 top_size.ScratchDataSizeInBytes),
                         .Flags = ResourceFlags::kAllowUnorderedAccess,
                         .Name = "scratch"})
          .value();

  // The pipeline: one hit group; the scene is a root SRV (t0), the image a table (u0).
  const RootSignature root_signature =
      device
          .CreateRootSignature(
              RootSignatureDesc{{RootParameter::Srv(0),
                                 RootParameter::Table({{.RangeType = DescriptorRangeType::kUav}})}})
          .value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_triangle()).value(), {}});
  desc.Add(HitGroupDesc{.HitGroupExport = "TriangleGroup", .ClosestHitShaderImport = "ClosestHit"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 12, .MaxAttributeSizeInBytes = 8});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 1});
  desc.Add(GlobalRootSignature{root_signature});
  const StateObject pipeline = device.CreateStateObject(desc).value();

  ShaderTable raygen_table(pipeline), miss_table(pipeline), hit_table(pipeline);
  raygen_table.AddRecord("RayGen").value();
  miss_table.AddRecord("Miss").value();
  hit_table.AddRecord("TriangleGroup").value();
  for (ShaderTable* table : {&raygen_table, &miss_table, &hit_table}) {
    table->Build(device).value();
  }

  // A barrier separates a build from whatever reads its result, and two uses of the same scratch
  // memory.
  CommandList list = device.CreateCommandList().value();
  list.BuildRaytracingAccelerationStructure(
      {.DestAccelerationStructureData = bottom_level.GetGPUVirtualAddress(),
       .Inputs = bottom,
       .ScratchAccelerationStructureData = scratch.GetGPUVirtualAddress()});
  list.ResourceBarrier(ResourceBarrier::Uav());
  list.BuildRaytracingAccelerationStructure(
      {.DestAccelerationStructureData = top_level.GetGPUVirtualAddress(),
       .Inputs = top,
       .ScratchAccelerationStructureData = scratch.GetGPUVirtualAddress()});
  list.ResourceBarrier(ResourceBarrier::Uav(top_level));

  list.SetDescriptorHeaps({image.heap});
  list.SetComputeRootSignature(root_signature);
  list.SetComputeRootShaderResourceView(0, top_level.GetGPUVirtualAddress());
  list.SetComputeRootDescriptorTable(1, image.heap.GetGPUDescriptorHandleForHeapStart());
  list.SetPipelineState1(pipeline);
  list.DispatchRays({.RayGenerationShaderRecord = raygen_table.GetRecord(0),
                     .MissShaderTable = miss_table.GetTable(),
                     .HitGroupTable = hit_table.GetTable(),
                     .Width = setup.width,
                     .Height = setup.height});
  setup.queue.ExecuteAndWait(list).value();
  return image.texture;
}

int main(int argc, char** argv) {
  return example::Main(argc, argv, "01-triangle", Render);
}
