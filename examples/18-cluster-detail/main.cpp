// SPDX-License-Identifier: MIT
// The device chooses what a bottom level is built from: a compute shader picks a fine or a coarse
// cluster for each tile, and writes the arguments of BUILD_BLAS_FROM_CLAS.
#include <shaders/detail.h>

#include <cmath>

#include "../common/example.h"
#include "../common/operations.h"

using namespace rtapi;

namespace {

constexpr uint32_t kTiles = 16;  // along a side, as in detail.hlsl
constexpr uint32_t kTileCount = kTiles * kTiles;
constexpr uint32_t kClusters = 2 * kTileCount;  // all fine ones, then all coarse ones
constexpr uint32_t kFineQuads = 10;             // along a side of a tile
constexpr uint32_t kCoarseQuads = 2;
constexpr uint32_t kMostTriangles = 2 * kFineQuads * kFineQuads;
constexpr uint32_t kMostVertices = (kFineQuads + 1) * (kFineQuads + 1);

// A tile with a hill of its own height.
void AddPositions(uint32_t tile, uint32_t quads, std::vector<float>& positions) {
  const float height = 0.35f + 0.3f * std::sin(2.4f * static_cast<float>(tile));
  const float middle_x = 1.25f * (static_cast<float>(tile % kTiles) - 0.5f * kTiles + 0.5f);
  const float middle_z = 1.25f * (static_cast<float>(tile / kTiles) - 0.5f * kTiles + 0.5f) + 3;
  for (uint32_t i = 0; i < (quads + 1) * (quads + 1); ++i) {
    const float x = static_cast<float>(i % (quads + 1)) / static_cast<float>(quads) * 2 - 1;
    const float z = static_cast<float>(i / (quads + 1)) / static_cast<float>(quads) * 2 - 1;
    const float y = height * (1 - x * x) * (1 - z * z) * (2.2f - std::cos(5 * x) * std::cos(5 * z));
    positions.insert(positions.end(), {middle_x + 0.55f * x, y, middle_z + 0.55f * z});
  }
}

std::vector<uint8_t> TileIndices(uint32_t quads) {
  std::vector<uint8_t> indices;
  for (uint32_t i = 0; i < quads * quads; ++i) {
    const uint32_t first = i / quads * (quads + 1) + i % quads;
    for (const uint32_t corner : {0u, quads + 1, 1u, 1u, quads + 1, quads + 2}) {
      indices.push_back(static_cast<uint8_t>(first + corner));
    }
  }
  return indices;
}

// The field, and what must live as long as it does.
struct Field {
  Buffer fine_indices, coarse_indices, positions;
  example::Batch clusters;
  Buffer chosen, arguments;
  example::Batch level;
};

void RecordClusters(const Device& device, CommandList& list, Field& field) {
  field.fine_indices = CreateUploadBuffer(device, TileIndices(kFineQuads), "fine").value();
  field.coarse_indices = CreateUploadBuffer(device, TileIndices(kCoarseQuads), "coarse").value();
  std::vector<float> positions;
  std::vector<RtasBuildClasFromTrianglesArgs> tiles(kClusters);
  for (uint32_t i = 0; i < kClusters; ++i) {
    const bool fine = i < kTileCount;
    const uint32_t quads = fine ? kFineQuads : kCoarseQuads;
    tiles[i].ClusterID = i;
    tiles[i].TriangleCount = static_cast<uint16_t>(2 * quads * quads);
    tiles[i].VertexCount = static_cast<uint16_t>((quads + 1) * (quads + 1));
    tiles[i].BaseGeometryIndexAndFlags = kRtasClusteredGeometryOpaque;
    tiles[i].VertexBuffer = positions.size() * sizeof(float);  // from the first on
    tiles[i].IndexBuffer =
        (fine ? field.fine_indices : field.coarse_indices).GetGPUVirtualAddress();
    AddPositions(i % kTileCount, quads, positions);
  }
  field.positions = CreateUploadBuffer(device, positions, "positions").value();
  for (auto& tile : tiles) tile.VertexBuffer += field.positions.GetGPUVirtualAddress();

  RtasClusterTrianglesInputsDesc desc;
  desc.Limits = {.MaxArgCount = kClusters,
                 .MaxTriangleCountPerCluster = kMostTriangles,
                 .MaxVertexCountPerCluster = kMostVertices,
                 .MaxTotalTriangleCount = kClusters * kMostTriangles,
                 .MaxTotalVertexCount = kClusters * kMostVertices};
  desc.Flags = RtasOperationFlags::kFastTrace | RtasOperationFlags::kAllowDataAccess;
  RtasOperationInputs inputs;
  inputs.Type = RtasOperationType::kBuildClasFromTriangles;
  inputs.pClusterTrianglesDesc = &desc;
  field.clusters = example::Record(device, list, inputs, tiles);
}

// The addresses of the chosen clusters and the arguments of the build never leave the device.
void RecordChoice(const Device& device, CommandList& list, const ShaderLibrary& library,
                  Field& field) {
  field.chosen = example::WritableBuffer(device, kTileCount * sizeof(uint64_t),
                                         ResourceStates::kUnorderedAccess, "chosen clusters");
  field.arguments = example::WritableBuffer(device, sizeof(RtasBuildBlasFromClasArgs),
                                            ResourceStates::kUnorderedAccess, "arguments");
  const RootSignature signature =
      device
          .CreateRootSignature(
              "SRV(t0), UAV(u0), UAV(u1), RootConstants(num32BitConstants = 2, b0)")
          .value();
  const PipelineState choose =
      device.CreateComputePipelineState({signature, library, "Choose", "choose"}).value();
  list.SetComputeRootSignature(signature);
  list.SetComputeRootShaderResourceView(0, field.clusters.addresses.GetGPUVirtualAddress());
  list.SetComputeRootUnorderedAccessView(1, field.chosen.GetGPUVirtualAddress());
  list.SetComputeRootUnorderedAccessView(2, field.arguments.GetGPUVirtualAddress());
  list.SetComputeRoot32BitConstants(3, field.chosen.GetGPUVirtualAddress());
  list.SetPipelineState(choose);
  list.Dispatch(kTileCount / 64, 1, 1);
  for (const Buffer& buffer : {field.chosen, field.arguments}) {
    list.ResourceBarrier(ResourceBarrier::Transition(buffer, ResourceStates::kUnorderedAccess,
                                                     ResourceStates::kNonPixelShaderResource));
  }
}

void RecordLevel(const Device& device, CommandList& list, Field& field) {
  RtasClasInputsDesc desc = {.Flags = RtasOperationFlags::kFastTrace,
                             .MaxArgCount = 1,
                             .MaxTotalClasCount = kTileCount,
                             .MaxClasCountPerArg = kTileCount};
  RtasOperationInputs inputs;
  inputs.Type = RtasOperationType::kBuildBlasFromClas;
  inputs.pClasDesc = &desc;
  field.level = example::Record(device, list, inputs, field.arguments, 1);
}

Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const example::Image image = example::CreateImage(setup);
  const ShaderLibrary library = LoadShaderLibrary(kaamos_shaders_detail()).value();
  CommandList build = device.CreateCommandList().value();
  Field field;
  RecordClusters(device, build, field);
  RecordChoice(device, build, library, field);
  RecordLevel(device, build, field);
  setup.queue.ExecuteAndWait(build).value();

  RaytracingInstanceDesc instance;
  instance.AccelerationStructure = field.level.Only();
  const Buffer scene = BuildTopLevel(device, setup.queue, {instance}, "scene").value();

  const RootSignature root_signature =
      device.CreateRootSignature("SRV(t0), DescriptorTable(UAV(u0))").value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{library, {{"RayGen"}, {"Miss"}, {"ClosestHit"}}});
  desc.Add(HitGroupDesc{.HitGroupExport = "Tile", .ClosestHitShaderImport = "ClosestHit"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 12});
  desc.Add(RaytracingPipelineConfig1{.MaxTraceRecursionDepth = 1,
                                     .Flags = RaytracingPipelineFlags::kAllowClusteredGeometry});
  desc.Add(GlobalRootSignature{root_signature});
  const StateObject pipeline = device.CreateStateObject(desc).value();
  ShaderTable raygen_table(pipeline), miss_table(pipeline), hit_table(pipeline);
  raygen_table.AddRecord("RayGen").value();
  miss_table.AddRecord("Miss").value();
  hit_table.AddRecord("Tile").value();
  for (ShaderTable* table : {&raygen_table, &miss_table, &hit_table}) {
    table->Build(device).value();
  }

  CommandList list = device.CreateCommandList().value();
  list.SetDescriptorHeaps({image.heap});
  list.SetComputeRootSignature(root_signature);
  list.SetComputeRootShaderResourceView(0, scene.GetGPUVirtualAddress());
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

}  // namespace

int main(int argc, char** argv) {
  // Clusters are experimental: a device has them where it is asked.
  const DeviceDesc experimental = {.ShaderModel = ShaderModel::k6_10,
                                   .IndirectRtasOperations = true};
  return example::Main(argc, argv, "18-cluster-detail", Render, {}, experimental);
}
