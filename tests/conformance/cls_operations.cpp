// SPDX-License-Identifier: MIT
#include "tests/conformance/cls.h"

namespace kaamos::conformance::cls {

RtasOperationInputs inputs_of(const TrianglesDesc& desc) {
  RtasOperationInputs in;
  in.Type = Type::kBuildClasFromTriangles;
  in.pClusterTrianglesDesc = &desc;
  return in;
}

RtasOperationInputs inputs_of(const RtasClasInputsDesc& desc) {
  RtasOperationInputs in;
  in.Type = Type::kBuildBlasFromClas;
  in.pClasDesc = &desc;
  return in;
}

RtasOperationInputs inputs_of(const RtasClusterTemplateTrianglesInputsDesc& desc) {
  RtasOperationInputs in;
  in.Type = Type::kBuildClusterTemplatesFromTriangles;
  in.pClusterTemplateTrianglesDesc = &desc;
  return in;
}

RtasOperationInputs inputs_of(const RtasInstantiateClusterTemplateInputsDesc& desc) {
  RtasOperationInputs in;
  in.Type = Type::kInstantiateClusterTemplates;
  in.pInstantiateClusterTemplateDesc = &desc;
  return in;
}

RtasOperationInputs inputs_of(const RtasClusterMovesDesc& desc) {
  RtasOperationInputs in;
  in.Type = Type::kMoveClusterObjects;
  in.pClusterMovesDesc = &desc;
  return in;
}

TrianglesDesc triangles_desc(uint32_t count, Flags flags) {
  TrianglesDesc desc;
  desc.Limits = {count, kRtasMaximumGeometryIndex, 256, 256, 256, 256 * count, 256 * count, 256};
  desc.Flags = flags;
  return desc;
}

RtasClasInputsDesc level_desc(uint32_t count, uint32_t clusters) {
  return {Flags::kNone, count, Mode::kImplicitDestinations, clusters, clusters};
}

Batch batch_of(Context& t, const RtasOperationInputs& inputs, const Buffer& arguments,
               uint32_t room) {
  const auto prebuild = t.device().GetRTASOperationPrebuildInfo(inputs);
  Batch batch;
  batch.memory = t.structure_memory(std::max<uint64_t>(prebuild.ResultDataMaxSizeInBytes, 256));
  batch.addresses = t.upload(std::vector<uint64_t>(room, kUntouched));
  batch.sizes = t.upload(std::vector<uint64_t>(room, kUntouched));
  batch.data.BatchResultData = batch.memory.GetGPUVirtualAddress();
  batch.data.BatchScratchData = t.zeros(prebuild.ScratchDataSizeInBytes).GetGPUVirtualAddress();
  batch.data.ResultAddressArray = {batch.addresses.GetGPUVirtualAddress(), 0};
  batch.data.ResultSizeArray = {batch.sizes.GetGPUVirtualAddress(), 0};
  if (arguments) batch.data.IndirectArgumentArray = {arguments.GetGPUVirtualAddress(), 0};
  return batch;
}

void add_operation(CommandList& list, const RtasOperationInputs& inputs, const Batch& batch) {
  RtasOperationDesc desc;
  desc.pInputs = &inputs;
  desc.pBatchedOperationData = &batch.data;
  list.ExecuteIndirectRTASOperations(std::span(&desc, 1));
}

Status run(Context& t, const RtasOperationInputs& inputs, const Batch& batch) {
  return execute(t, [&](CommandList& list) { add_operation(list, inputs, batch); });
}

std::vector<uint64_t> addresses_in(Context& t, const Batch& batch) {
  return words64(t.read(batch.addresses));
}
std::vector<uint64_t> sizes_in(Context& t, const Batch& batch) {
  return words64(t.read(batch.sizes));
}

ClusterArgs cluster(Context& t, const std::vector<float>& vertices,
                    const std::vector<uint8_t>& indices) {
  ClusterArgs args;
  args.TriangleCount = static_cast<uint16_t>(indices.size() / 3);
  args.VertexCount = static_cast<uint16_t>(vertices.size() / 3);
  args.BaseGeometryIndexAndFlags = kRtasClusteredGeometryOpaque;
  args.VertexBuffer = t.upload(vertices).GetGPUVirtualAddress();
  args.IndexBuffer = t.upload(indices).GetGPUVirtualAddress();
  return args;
}

ClusterArgs cluster(Context& t, const Geometry& geometry, uint32_t geometry_index,
                    uint32_t cluster_id) {
  std::vector<uint8_t> indices;
  for (size_t i = 0; i < geometry.vertices.size() / 3; ++i) {
    indices.push_back(static_cast<uint8_t>(i));
  }
  ClusterArgs args = cluster(t, geometry.vertices, indices);
  const bool opaque = HasAny(geometry.flags, RaytracingGeometryFlags::kOpaque);
  args.BaseGeometryIndexAndFlags = geometry_index | (opaque ? kRtasClusteredGeometryOpaque : 0);
  args.ClusterID = cluster_id;
  return args;
}

uint64_t level_of(Context& t, const std::vector<uint64_t>& clusters) {
  const auto count = static_cast<uint32_t>(clusters.size());
  LevelArgs args;
  args.ClasAddressCount = count;
  if (count != 0) args.ClasAddressArray = t.upload(clusters).GetGPUVirtualAddress();
  return build(t, level_desc(1, count), std::vector<LevelArgs>{args})[0];
}

uint64_t level_from(Context& t, const std::vector<ClusterArgs>& clusters, Flags flags) {
  const auto count = static_cast<uint32_t>(clusters.size());
  return level_of(t, build(t, triangles_desc(count, flags), clusters));
}

RaytracingInstanceDesc instance_of(uint64_t level) {
  RaytracingInstanceDesc desc;
  desc.AccelerationStructure = level;
  return desc;
}

Buffer top_of(Context& t, uint64_t level) {
  return t.top_level({instance_of(level)});
}

std::vector<Seen> look(Context& t, const Buffer& top, const std::vector<float>& places) {
  return ptl::look(t, top, places);
}

std::vector<float> depths_at(Context& t, const Buffer& top, const std::vector<float>& places) {
  std::vector<float> depths;
  for (const Seen& seen : look(t, top, places)) {
    depths.push_back(seen.end == kClosestHitRan ? seen.t : -1);
  }
  return depths;
}

}  // namespace kaamos::conformance::cls
