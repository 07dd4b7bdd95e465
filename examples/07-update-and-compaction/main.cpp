// SPDX-License-Identifier: MIT
// Compacts a bottom level, then updates it after its vertices have moved.
#include <shaders/wave.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "../common/example.h"

using namespace rtapi;
using BuildFlags = RaytracingAccelerationStructureBuildFlags;

static constexpr uint32_t kCells = 48;

static std::vector<float> Wave(float phase) {
  std::vector<float> positions;
  for (uint32_t i = 0; i <= kCells; ++i) {
    for (uint32_t j = 0; j <= kCells; ++j) {
      const float x = 2.0f * static_cast<float>(j) / kCells - 1;
      const float z = 2.0f * static_cast<float>(i) / kCells - 1;
      positions.insert(positions.end(), {x, 0.25f * std::sin(9 * std::hypot(x, z) - phase), z});
    }
  }
  return positions;
}

static Buffer CreateAccelerationStructure(const Device& device, uint64_t bytes, const char* name) {
  return device
      .CreateBuffer({.SizeInBytes = bytes,
                     .Flags = ResourceFlags::kAllowUnorderedAccess,
                     .InitialState = ResourceStates::kRaytracingAccelerationStructure,
                     .Name = name})
      .value();
}

static Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const CommandQueue& queue = setup.queue;
  const example::Image image = example::CreateImage(setup);

  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < kCells; ++i) {
    for (uint32_t j = 0; j < kCells; ++j) {
      const uint32_t a = i * (kCells + 1) + j;
      const uint32_t c = a + kCells + 1;
      indices.insert(indices.end(), {a, c, a + 1, a + 1, c, c + 1});
    }
  }
  const example::Mesh mesh = example::CreateMesh(setup, Wave(0), indices);
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.Flags = BuildFlags::kAllowUpdate | BuildFlags::kAllowCompaction;
  inputs.NumDescs = 1;
  inputs.pGeometryDescs = &mesh.geometry;
  const auto sizes = device.GetRaytracingAccelerationStructurePrebuildInfo(inputs).value();
  const Buffer built = CreateAccelerationStructure(device, sizes.ResultDataMaxSizeInBytes, "built");
  const Buffer scratch =
      device
          .CreateBuffer({.SizeInBytes = std::max(sizes.ScratchDataSizeInBytes,
                                                 sizes.UpdateScratchDataSizeInBytes),
                         .Flags = ResourceFlags::kAllowUnorderedAccess,
                         .Name = "scratch"})
          .value();
  const Buffer size_result = device
                                 .CreateBuffer({.SizeInBytes = 8,
                                                .Flags = ResourceFlags::kAllowUnorderedAccess,
                                                .Name = "compacted size"})
                                 .value();

  // Build, and query the compacted size.
  const RaytracingAccelerationStructurePostbuildInfoDesc compacted_size = {
      size_result.GetGPUVirtualAddress()};
  CommandList list = device.CreateCommandList().value();
  list.BuildRaytracingAccelerationStructure(
      {.DestAccelerationStructureData = built.GetGPUVirtualAddress(),
       .Inputs = inputs,
       .ScratchAccelerationStructureData = scratch.GetGPUVirtualAddress()},
      {&compacted_size, 1});
  queue.ExecuteAndWait(list).value();
  uint64_t compacted_bytes = 0;
  const auto bytes = ReadbackBuffer(device, queue, size_result).value();
  std::memcpy(&compacted_bytes, bytes.data(), sizeof compacted_bytes);
  std::printf("bottom level: %llu bytes, compacted %llu\n",
              static_cast<unsigned long long>(sizes.ResultDataMaxSizeInBytes),
              static_cast<unsigned long long>(compacted_bytes));

  // Copy into a buffer of that size. The vertices have moved: an update of the original goes into
  // another buffer.
  const Buffer compacted = CreateAccelerationStructure(device, compacted_bytes, "compacted");
  const Buffer updated =
      CreateAccelerationStructure(device, sizes.ResultDataMaxSizeInBytes, "updated");
  const std::vector<float> moved = Wave(3.14159265f);
  std::copy(moved.begin(), moved.end(), mesh.vertices.data<float>().begin());
  list.Reset().value();
  list.CopyRaytracingAccelerationStructure(compacted.GetGPUVirtualAddress(),
                                           built.GetGPUVirtualAddress(),
                                           RaytracingAccelerationStructureCopyMode::kCompact);
  list.ResourceBarrier(ResourceBarrier::Uav());
  inputs.Flags = inputs.Flags | BuildFlags::kPerformUpdate;
  list.BuildRaytracingAccelerationStructure(
      {.DestAccelerationStructureData = updated.GetGPUVirtualAddress(),
       .Inputs = inputs,
       .SourceAccelerationStructureData = built.GetGPUVirtualAddress(),
       .ScratchAccelerationStructureData = scratch.GetGPUVirtualAddress()});
  queue.ExecuteAndWait(list).value();
  const Buffer before =
      BuildTopLevel(setup.device, setup.queue, {example::Instance(compacted, 0, 0, 0)}, "top level")
          .value();
  const Buffer after =
      BuildTopLevel(setup.device, setup.queue, {example::Instance(updated, 0, 0, 0)}, "top level")
          .value();

  const RootSignature root_signature =
      device.CreateRootSignature("SRV(t0), SRV(t1), DescriptorTable(UAV(u0))").value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_wave()).value(), {}});
  desc.Add(HitGroupDesc{.HitGroupExport = "WaveGroup", .ClosestHitShaderImport = "ClosestHit"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 12});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 1});
  desc.Add(GlobalRootSignature{root_signature});
  const StateObject pipeline = device.CreateStateObject(desc).value();
  ShaderTable raygen_table(pipeline), miss_table(pipeline), hit_table(pipeline);
  raygen_table.AddRecord("RayGen").value();
  miss_table.AddRecord("Miss").value();
  hit_table.AddRecord("WaveGroup").value();
  for (ShaderTable* table : {&raygen_table, &miss_table, &hit_table}) {
    table->Build(device).value();
  }

  list.Reset().value();
  list.SetDescriptorHeaps({image.heap});
  list.SetComputeRootSignature(root_signature);
  list.SetComputeRootShaderResourceView(0, before.GetGPUVirtualAddress());
  list.SetComputeRootShaderResourceView(1, after.GetGPUVirtualAddress());
  list.SetComputeRootDescriptorTable(2, image.heap.GetGPUDescriptorHandleForHeapStart());
  list.SetPipelineState1(pipeline);
  list.DispatchRays({.RayGenerationShaderRecord = raygen_table.GetRecord(0),
                     .MissShaderTable = miss_table.GetTable(),
                     .HitGroupTable = hit_table.GetTable(),
                     .Width = setup.width,
                     .Height = setup.height});
  queue.ExecuteAndWait(list).value();
  return image.texture;
}

int main(int argc, char** argv) {
  return example::Main(argc, argv, "07-update-and-compaction", Render);
}
