// SPDX-License-Identifier: MIT
//
// The arguments that make the same, and what their addresses name.
// [DXR: COPY_MODE_VISUALIZATION_DECODE_FOR_TOOLS]
#include <cstring>

#include "runtime/structures/cluster.h"
#include "runtime/structures/partitioned_instances.h"
#include "runtime/structures/serialized_objects.h"

namespace kaamos::runtime {
namespace {

using Type = rtapi::RaytracingAccelerationStructureType;
using ToolsHeader = rtapi::BuildRaytracingAccelerationStructureToolsVisualizationHeader;
using TrianglesArgs = rtapi::RtasBuildClasFromTrianglesArgs;
using PartitionedOperation = rtapi::RtasPartitionedTlasOperation;

// A header, `count` descs, and arrays behind them.
template <class Desc>
class Decoded {
 public:
  Decoded(uint64_t address, Type type, uint32_t count) : address_(address) {
    ToolsHeader header;
    header.Type = type;
    header.NumDescs = count;
    bytes_.resize(sizeof(header) + count * sizeof(Desc));
    std::memcpy(bytes_.data(), &header, sizeof(header));
  }
  void set(uint32_t index, const Desc& desc) {
    std::memcpy(&bytes_[sizeof(ToolsHeader) + index * sizeof(desc)], &desc, sizeof(desc));
  }
  // Where it is; 0 if it is empty.
  template <class T>
  uint64_t add(const std::vector<T>& values, uint64_t alignment = 8) {
    if (values.empty()) return 0;
    const uint64_t at = (bytes_.size() + alignment - 1) / alignment * alignment;
    const uint64_t bytes = values.size() * sizeof(T);
    bytes_.resize(padded(at + bytes));
    std::memcpy(&bytes_[at], values.data(), bytes);
    return address_ + at;
  }
  std::vector<uint8_t> take() { return std::move(bytes_); }

 private:
  uint64_t address_;
  std::vector<uint8_t> bytes_;
};

// All but vertices and indices, whose formats differ. Geometry indices and flags are as they are by
// triangle, with no indices of their own.
template <class Desc>
TrianglesArgs args_of(const Cluster& cluster, uint32_t vertices, Decoded<Desc>& out) {
  using Flags = rtapi::RtasClusterFlags;
  TrianglesArgs args;
  args.ClusterID = cluster.id;
  args.ClusterFlags = (cluster.allows_disable_omms ? Flags::kAllowDisableOmms : Flags::kNone) |
                      (cluster.data_access ? Flags::kNone : Flags::kDisallowDataAccess);
  args.TriangleCount = static_cast<uint16_t>(cluster.triangles());
  args.VertexCount = static_cast<uint16_t>(vertices);
  args.GeometryIndexAndFlagsArray = out.add(cluster.geometry);
  if (cluster.linkage == nullptr) return args;
  args.OpacityMicromapArray = cluster.linkage->address;
  args.OpacityMicromapIndexBuffer = out.add(cluster.linkage->indices);
  return args;
}

std::vector<uint8_t> decode(const Cluster& cluster, uint64_t address) {
  Decoded<TrianglesArgs> out(address, Type::kClusterLevel, 1);
  constexpr uint32_t kMost = rtapi::kRtasMaxClusterElements;
  const auto vertices = std::min<uint32_t>(static_cast<uint32_t>(cluster.xyz.size() / 3), kMost);
  TrianglesArgs args = args_of(cluster, vertices, out);
  const auto end = cluster.xyz.begin() + 3 * static_cast<std::ptrdiff_t>(vertices);
  args.VertexBuffer = out.add(std::vector<float>(cluster.xyz.begin(), end));
  std::vector<uint8_t> indices(cluster.indices.size());
  for (size_t i = 0; i < indices.size(); ++i) {
    // A triangle with the vertex that does not exist is never hit, nor is one of a single vertex.
    const size_t first = i / 3 * 3;
    const bool hit = cluster.indices[first] < kMost && cluster.indices[first + 1] < kMost &&
                     cluster.indices[first + 2] < kMost;
    indices[i] = hit ? static_cast<uint8_t>(cluster.indices[i]) : uint8_t{0};
  }
  args.IndexBuffer = out.add(indices);
  out.set(0, args);
  return out.take();
}

std::vector<uint8_t> decode(const ClusterTemplate& from, uint64_t address) {
  using Args = rtapi::RtasBuildClusterTemplatesFromTrianglesArgs;
  Decoded<Args> out(address, Type::kClusterTemplate, 1);
  Args args;
  args.TrianglesArgs = args_of(from.cluster, from.vertices, out);
  args.TrianglesArgs.IndexBuffer =
      out.add(std::vector<uint32_t>(from.cluster.indices.begin(), from.cluster.indices.end()));
  args.TrianglesArgs.PositionTruncateBitCount = static_cast<uint16_t>(from.truncated_bits);
  if (from.format == rtapi::RtasVertexFormat::kCompressed1) {
    args.Compressed1TemplateHeader = from.compressed_header;
  } else if (from.bounded) {
    std::vector<float> box(from.lower, from.lower + 3);
    box.insert(box.end(), from.upper, from.upper + 3);
    args.InstantiationBoundingBoxLimit = out.add(box, rtapi::kRtasClusterTemplateByteAlignment);
  }
  out.set(0, args);
  return out.take();
}

std::vector<uint8_t> decode(const std::vector<uint64_t>& clusters, uint64_t address) {
  Decoded<rtapi::RtasBuildBlasFromClasArgs> out(address, Type::kClusteredBottomLevel, 1);
  rtapi::RtasBuildBlasFromClasArgs args;
  args.ClasAddressCount = static_cast<uint32_t>(clusters.size());
  args.ClasAddressArray = out.add(clusters);
  out.set(0, args);
  return out.take();
}

std::vector<uint8_t> decode(const PartitionedTopLevel& level, uint64_t address) {
  using OperationType = rtapi::RtasPartitionedTlasOperationType;
  std::vector<rtapi::RtasPartitionedTlasWriteInstanceArgs> writes;
  for (uint32_t i = 0; i < level.slots.size(); ++i) {
    if (!level.slots[i].written) continue;
    writes.push_back(level.slots[i].args);
    writes.back().InstanceIndex = i;
  }
  std::vector<rtapi::RtasPartitionedTlasTranslatePartitionArgs> translations;
  const auto translate = [&](uint32_t partition, const Translation& by) {
    if (by != Translation{}) translations.push_back({partition, {by[0], by[1], by[2]}});
  };
  for (uint32_t i = 0; i < level.translations.size(); ++i) translate(i, level.translations[i]);
  translate(rtapi::kRtasPartitionIndexGlobalPartition, level.global_translation);
  const uint32_t count = translations.empty() ? 1 : 2;
  Decoded<PartitionedOperation> out(address, Type::kPartitionedTopLevel, count);
  PartitionedOperation operation;
  operation.ArgCount = static_cast<uint32_t>(writes.size());
  operation.ArgData.StartAddress = out.add(writes);
  out.set(0, operation);
  if (translations.empty()) return out.take();
  operation.Type = OperationType::kTranslatePartition;
  operation.ArgCount = static_cast<uint32_t>(translations.size());
  operation.ArgData.StartAddress = out.add(translations);
  out.set(1, operation);
  return out.take();
}

}  // namespace

std::vector<uint8_t> decoded_object(const AccelerationStructure& structure, uint64_t address) {
  if (structure.cluster != nullptr) return decode(*structure.cluster, address);
  if (structure.cluster_template != nullptr) return decode(*structure.cluster_template, address);
  if (structure.of_clusters) return decode(*structure.clusters, address);
  return decode(*structure.partitioned, address);
}

}  // namespace kaamos::runtime
