// SPDX-License-Identifier: MIT
// A landscape of clusters: one template with the triangles of a tile, an instance of it for each
// tile, and a bottom level of them, whose addresses never leave the device's memory.
#include <shaders/landscape.h>

#include <cmath>

#include "../common/example.h"
#include "../common/operations.h"

using namespace rtapi;

namespace {

constexpr uint32_t kTiles = 8;  // along a side, a cluster each
constexpr uint32_t kClusters = kTiles * kTiles;
constexpr uint32_t kQuads = 8;  // along a side of a tile
constexpr uint32_t kTriangles = 2 * kQuads * kQuads;
constexpr uint32_t kVertices = (kQuads + 1) * (kQuads + 1);

RtasClusterLimits Limits(uint32_t clusters) {
  return {.MaxArgCount = clusters,
          .MaxTriangleCountPerCluster = kTriangles,
          .MaxVertexCountPerCluster = kVertices,
          .MaxTotalTriangleCount = clusters * kTriangles,
          .MaxTotalVertexCount = clusters * kVertices};
}

// The triangles of a tile, two for each quad.
std::vector<uint8_t> TileIndices() {
  std::vector<uint8_t> indices;
  for (uint32_t z = 0; z < kQuads; ++z) {
    for (uint32_t x = 0; x < kQuads; ++x) {
      const uint32_t first = z * (kQuads + 1) + x;
      for (const uint32_t corner : {0u, kQuads + 1, 1u, 1u, kQuads + 1, kQuads + 2}) {
        indices.push_back(static_cast<uint8_t>(first + corner));
      }
    }
  }
  return indices;
}

// x, y and z of all vertices, tile by tile: the landscape is 12 units wide.
std::vector<float> Positions() {
  std::vector<float> positions;
  for (uint32_t tile = 0; tile < kClusters; ++tile) {
    for (uint32_t vertex = 0; vertex < kVertices; ++vertex) {
      const uint32_t column = tile % kTiles * kQuads + vertex % (kQuads + 1);
      const uint32_t row = tile / kTiles * kQuads + vertex / (kQuads + 1);
      const float x = 12.0f * static_cast<float>(column) / (kTiles * kQuads) - 6;
      const float z = 12.0f * static_cast<float>(row) / (kTiles * kQuads) - 6;
      const float y = 0.6f * std::sin(1.1f * x) * std::cos(0.9f * z + 0.5f * x);
      positions.insert(positions.end(), {x, y, z});
    }
  }
  return positions;
}

// The landscape, and what must live as long as it does.
struct Landscape {
  example::Batch tile, clusters, level;
  Buffer indices, positions;
};

Landscape RecordLandscape(const Device& device, CommandList& list) {
  Landscape made;
  made.indices = CreateUploadBuffer(device, TileIndices(), "indices of a tile").value();
  made.positions = CreateUploadBuffer(device, Positions(), "positions").value();

  // A template: triangles without positions.
  RtasClusterTemplateTrianglesInputsDesc template_desc;
  template_desc.Limits = Limits(1);
  template_desc.Flags = RtasOperationFlags::kFastTrace;
  RtasBuildClusterTemplatesFromTrianglesArgs tile;
  tile.TrianglesArgs.TriangleCount = kTriangles;
  tile.TrianglesArgs.VertexCount = kVertices;
  tile.TrianglesArgs.BaseGeometryIndexAndFlags = kRtasClusteredGeometryOpaque;
  tile.TrianglesArgs.IndexBuffer = made.indices.GetGPUVirtualAddress();
  RtasOperationInputs inputs;
  inputs.Type = RtasOperationType::kBuildClusterTemplatesFromTriangles;
  inputs.pClusterTemplateTrianglesDesc = &template_desc;
  made.tile = example::Record(device, list, inputs, std::vector{tile});

  // A cluster for each tile: the template with positions, and a ClusterID.
  RtasInstantiateClusterTemplateInputsDesc instance_desc;
  instance_desc.Limits = Limits(kClusters);
  instance_desc.Flags = RtasOperationFlags::kFastTrace;
  std::vector<RtasInstantiateClusterTemplatesArgs> tiles(kClusters);
  for (uint32_t i = 0; i < kClusters; ++i) {
    const uint64_t first = uint64_t{i} * kVertices * 3 * sizeof(float);
    tiles[i].ClusterIdOffset = i;
    tiles[i].ClusterTemplate = made.tile.Only();
    tiles[i].VertexBuffer = {made.positions.GetGPUVirtualAddress() + first, 3 * sizeof(float)};
  }
  inputs.Type = RtasOperationType::kInstantiateClusterTemplates;
  inputs.pInstantiateClusterTemplateDesc = &instance_desc;
  made.clusters = example::Record(device, list, inputs, tiles);

  // A bottom level of all clusters, whose addresses the operation before has written.
  RtasClasInputsDesc level_desc = {.Flags = RtasOperationFlags::kFastTrace,
                                   .MaxArgCount = 1,
                                   .MaxTotalClasCount = kClusters,
                                   .MaxClasCountPerArg = kClusters};
  RtasBuildBlasFromClasArgs level;
  level.ClasAddressCount = kClusters;
  level.ClasAddressArray = made.clusters.addresses.GetGPUVirtualAddress();
  inputs.Type = RtasOperationType::kBuildBlasFromClas;
  inputs.pClasDesc = &level_desc;
  made.level = example::Record(device, list, inputs, std::vector{level});
  return made;
}

Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const example::Image image = example::CreateImage(setup);
  CommandList build = device.CreateCommandList().value();
  const Landscape landscape = RecordLandscape(device, build);
  setup.queue.ExecuteAndWait(build).value();

  RaytracingInstanceDesc instance;
  instance.AccelerationStructure = landscape.level.Only();
  const Buffer scene = BuildTopLevel(device, setup.queue, {instance}, "scene").value();

  const RootSignature root_signature =
      device.CreateRootSignature("SRV(t0), DescriptorTable(UAV(u0))").value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_landscape()).value(), {}});
  desc.Add(HitGroupDesc{.HitGroupExport = "Surface", .ClosestHitShaderImport = "ClosestHit"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 12});
  desc.Add(RaytracingPipelineConfig1{.MaxTraceRecursionDepth = 2,
                                     .Flags = RaytracingPipelineFlags::kAllowClusteredGeometry});
  desc.Add(GlobalRootSignature{root_signature});
  const StateObject pipeline = device.CreateStateObject(desc).value();
  ShaderTable raygen_table(pipeline), miss_table(pipeline), hit_table(pipeline);
  raygen_table.AddRecord("RayGen").value();
  miss_table.AddRecord("PrimaryMiss").value();
  miss_table.AddRecord("ShadowMiss").value();
  hit_table.AddRecord("Surface").value();
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
  return example::Main(argc, argv, "17-clusters", Render, {}, experimental);
}
