// SPDX-License-Identifier: MIT
#include "runtime/structures/serialized_objects.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "runtime/structures/cluster.h"
#include "runtime/structures/partitioned_instances.h"

namespace kaamos::runtime {
namespace {

using Type = rtapi::RaytracingAccelerationStructureType;
using rtapi::SerializedBlockType;
using WriteArgs = rtapi::RtasPartitionedTlasWriteInstanceArgs;

constexpr BuildFlags kHints = BuildFlags::kPreferFastTrace | BuildFlags::kPreferFastBuild;
constexpr uint32_t kMostElements = 1u << 24;  // instances and partitions

constexpr uint32_t kDataAccess = 1;
constexpr uint32_t kAllowsDisableOmms = 2;
constexpr uint32_t kLinked = 4;

struct ClusterRecord {
  uint32_t id;
  uint32_t flags;
  uint32_t vertices;
  uint32_t triangles;
};
struct TemplateRecord {
  uint32_t vertices;
  uint32_t format;
  uint32_t compressed_header;
  uint32_t truncated_bits;
  uint32_t bounded;
  float lower[3];
  float upper[3];
  uint32_t reserved;
};
struct PartitionedRecord {
  rtapi::RtasPartitionedTlasInputsDesc inputs;
  float global_translation[3];
};
static_assert(sizeof(ClusterRecord) == 16 && sizeof(TemplateRecord) == 48 &&
              sizeof(PartitionedRecord) == 32);

Type type_of(const AccelerationStructure& structure) {
  if (structure.cluster != nullptr) return Type::kClusterLevel;
  if (structure.cluster_template != nullptr) return Type::kClusterTemplate;
  return structure.of_clusters ? Type::kClusteredBottomLevel : Type::kPartitionedTopLevel;
}

// Returns the cluster itself, or the one that a template is made from.
const Cluster& cluster_of(const AccelerationStructure& structure) {
  return structure.cluster != nullptr ? *structure.cluster : structure.cluster_template->cluster;
}

void put_cluster(const Cluster& cluster, SerializedWriter& writer) {
  ClusterRecord record;
  record.id = cluster.id;
  record.flags = (cluster.data_access ? kDataAccess : 0) |
                 (cluster.allows_disable_omms ? kAllowsDisableOmms : 0) |
                 (cluster.linkage != nullptr ? kLinked : 0);
  record.vertices = static_cast<uint32_t>(cluster.xyz.size() / 3);
  record.triangles = cluster.triangles();
  writer.put(record);
  writer.put_array(cluster.xyz);
  writer.put_array(cluster.indices);
  writer.put_array(cluster.geometry);
  if (cluster.linkage != nullptr) writer.put_array(cluster.linkage->indices);
}

void put_template(const ClusterTemplate& from, SerializedWriter& writer) {
  TemplateRecord record = {};
  record.vertices = from.vertices;
  record.format = static_cast<uint32_t>(from.format);
  record.compressed_header = from.compressed_header;
  record.truncated_bits = from.truncated_bits;
  record.bounded = from.bounded ? 1 : 0;
  std::copy_n(from.lower, 3, record.lower);
  std::copy_n(from.upper, 3, record.upper);
  writer.put(record);
  put_cluster(from.cluster, writer);
}

void put_partitioned(const PartitionedTopLevel& level, SerializedWriter& writer) {
  PartitionedRecord record = {level.inputs, {}};
  std::copy_n(level.global_translation.begin(), 3, record.global_translation);
  writer.put(record);
  writer.put_array(level.translations);
  for (const PartitionedInstance& slot : level.slots) {
    WriteArgs args = slot.args;
    args.AccelerationStructure = 0;  // in the list after the header
    args.InstanceIndex = slot.written ? 1 : 0;
    writer.put(args);
  }
}

// A damaged cluster has no index past its vertices.
bool get_cluster(const SerializedFrame& frame, SerializedReader& reader, bool positions,
                 Cluster& cluster) {
  ClusterRecord record;
  if (!reader.get(record) || record.flags > 7 ||
      record.triangles > rtapi::kRtasMaxClusterElements) {
    return false;
  }
  const bool linked = (record.flags & kLinked) != 0;
  cluster.id = record.id;
  cluster.data_access = (record.flags & kDataAccess) != 0;
  cluster.allows_disable_omms = (record.flags & kAllowsDisableOmms) != 0;
  if (!reader.get_array(3 * uint64_t{record.vertices}, cluster.xyz) ||
      !reader.get_array(3 * uint64_t{record.triangles}, cluster.indices) ||
      !reader.get_array(record.triangles, cluster.geometry) ||
      linked != (frame.pointers.size() == 1)) {
    return false;
  }
  const uint32_t limit = positions ? record.vertices : rtapi::kRtasMaxClusterElements + 1;
  for (const uint16_t index : cluster.indices) {
    if (index >= limit) return false;
  }
  if (!linked) return true;
  cluster.linkage = std::make_shared<MicromapLinkage>();
  cluster.linkage->address = frame.pointers[0];
  if (!reader.get_array(record.triangles, cluster.linkage->indices)) return false;
  const auto least = static_cast<int32_t>(SpecialIndex::kClusterSkip);
  return std::all_of(cluster.linkage->indices.begin(), cluster.linkage->indices.end(),
                     [least](int32_t index) { return index >= least; });
}

bool get_template(const SerializedFrame& frame, SerializedReader& reader, ClusterTemplate& result) {
  TemplateRecord record;
  if (!reader.get(record) || record.vertices > 0xFFFF || record.format == 0 ||
      record.format > static_cast<uint32_t>(rtapi::RtasVertexFormat::kCompressed1) ||
      record.truncated_bits > 32 || record.bounded > 1) {
    return false;
  }
  result.vertices = record.vertices;
  result.format = static_cast<rtapi::RtasVertexFormat>(record.format);
  result.compressed_header = record.compressed_header;
  result.truncated_bits = record.truncated_bits;
  result.bounded = record.bounded != 0;
  std::copy_n(record.lower, 3, result.lower);
  std::copy_n(record.upper, 3, result.upper);
  return get_cluster(frame, reader, false, result.cluster) && result.cluster.xyz.empty();
}

bool get_partitioned(const SerializedFrame& frame, SerializedReader& reader,
                     PartitionedTopLevel& level) {
  PartitionedRecord record;
  if (!reader.get(record)) return false;
  level.inputs = record.inputs;
  std::copy_n(record.global_translation, 3, level.global_translation.begin());
  const uint32_t partitions = level.inputs.PartitionCount;
  if (static_cast<uint32_t>(level.inputs.Flags) > 7 || level.inputs.InstanceCount != frame.count ||
      frame.pointers.size() != frame.count || partitions > kMostElements ||
      frame.count > reader.left() / sizeof(WriteArgs) ||
      !reader.get_array(level.translates() ? partitions : 0, level.translations)) {
    return false;
  }
  level.slots.resize(frame.count);
  level.instances.resize(frame.count);
  for (uint32_t i = 0; i < frame.count; ++i) {
    PartitionedInstance& slot = level.slots[i];
    if (!reader.get(slot.args) || slot.args.InstanceIndex > 1) return false;
    slot.written = slot.args.InstanceIndex != 0;
    slot.args.InstanceIndex = i;
    slot.args.AccelerationStructure = frame.pointers[i];
    const bool global = slot.args.PartitionIndex == rtapi::kRtasPartitionIndexGlobalPartition;
    const bool sound = slot.args.InstanceMask <= 0xFF &&
                       slot.args.InstanceContributionToHitGroupIndex < kMostElements &&
                       static_cast<uint32_t>(slot.args.InstanceFlags) <= 0x7F &&
                       (global || slot.args.PartitionIndex < partitions);
    if (slot.written && !sound) return false;
  }
  return true;
}

// The block that a serialized object of this type has, if it refers to anything.
SerializedBlockType block_of(Type type) {
  if (type == Type::kClusteredBottomLevel) return SerializedBlockType::kClusterLevel;
  return type == Type::kPartitionedTopLevel ? SerializedBlockType::kBottomLevel
                                            : SerializedBlockType::kOpacityMicromaps;
}

uint64_t alignment_of(Type type) {
  if (type == Type::kClusterLevel) return rtapi::kRtasClasByteAlignment;
  return type == Type::kClusterTemplate ? rtapi::kRtasClusterTemplateByteAlignment
                                        : rtapi::kRaytracingAccelerationStructureByteAlignment;
}

// What the frame says must fit the type.
rtapi::Status check_frame(const SerializedFrame& frame) {
  const bool level = frame.type == Type::kClusteredBottomLevel;
  const bool top = frame.type == Type::kPartitionedTopLevel;
  const auto flags = static_cast<BuildFlags>(frame.flags);
  const bool flags_fit = level ? (flags & ~kHints) == BuildFlags::kNone && flags != kHints
                               : flags == BuildFlags::kNone;
  const bool counts_fit = top     ? frame.count <= kMostElements
                          : level ? frame.count == frame.pointers.size()
                                  : frame.count == 1;
  const bool has_block = frame.block == block_of(frame.type);
  const bool block_fits =
      level || top ? has_block : has_block || (!frame.block && frame.pointers.empty());
  if (!flags_fit || !counts_fit || !block_fits) {
    return serialized_error(
        "its contents are damaged: type " + std::to_string(static_cast<uint32_t>(frame.type)) +
        " of " + std::to_string(frame.count) + " with build flags " + std::to_string(frame.flags));
  }
  const uint64_t alignment = alignment_of(frame.type);
  if (frame.size_bytes < 128 || frame.size_bytes % alignment != 0) {
    return serialized_error("DeserializedSizeInBytes is " + std::to_string(frame.size_bytes) +
                            "; it must be a multiple of " + std::to_string(alignment));
  }
  return {};
}

}  // namespace

SerializedFrame frame_of_object(const AccelerationStructure& structure) {
  SerializedFrame frame;
  frame.type = type_of(structure);
  frame.size_bytes = structure.size_bytes;
  frame.count = 1;
  if (structure.of_clusters) {
    frame.flags = static_cast<uint32_t>(structure.flags & kHints);
    frame.pointers = *structure.clusters;
    frame.count = frame.pointers.size();
  } else if (structure.partitioned != nullptr) {
    for (const PartitionedInstance& slot : structure.partitioned->slots) {
      frame.pointers.push_back(slot.written ? slot.args.AccelerationStructure : 0);
    }
    frame.count = frame.pointers.size();
  } else if (const auto& linkage = cluster_of(structure).linkage; linkage != nullptr) {
    frame.pointers = {linkage->address};
  } else {
    return frame;
  }
  frame.block = block_of(frame.type);
  return frame;
}

void put_object(const AccelerationStructure& structure, SerializedWriter& writer) {
  if (structure.cluster != nullptr) return put_cluster(*structure.cluster, writer);
  if (structure.cluster_template != nullptr) {
    return put_template(*structure.cluster_template, writer);
  }
  if (structure.partitioned != nullptr) put_partitioned(*structure.partitioned, writer);
}

rtapi::Status get_object(const SerializedFrame& frame, SerializedReader& reader,
                         SerializedStructure& result) {
  if (auto s = check_frame(frame); !s) return s;
  result.flags = static_cast<BuildFlags>(frame.flags);
  bool sound = true;
  if (frame.type == Type::kClusterLevel) {
    auto cluster = std::make_shared<Cluster>();
    sound = get_cluster(frame, reader, true, *cluster);
    if (cluster->linkage != nullptr) result.linkages = {cluster->linkage};
    result.cluster = std::move(cluster);
  } else if (frame.type == Type::kClusterTemplate) {
    auto made = std::make_shared<ClusterTemplate>();
    sound = get_template(frame, reader, *made);
    if (made->cluster.linkage != nullptr) result.linkages = {made->cluster.linkage};
    result.cluster_template = std::move(made);
  } else if (frame.type == Type::kClusteredBottomLevel) {
    result.clusters = frame.pointers;
  } else {
    auto level = std::make_shared<PartitionedTopLevel>();
    sound = get_partitioned(frame, reader, *level);
    result.partitioned = std::move(level);
  }
  if (sound) return {};
  static constexpr const char* kNames[] = {"cluster", "cluster template", "bottom level",
                                           "partitioned top level"};
  const auto name = static_cast<uint32_t>(frame.type) - static_cast<uint32_t>(Type::kClusterLevel);
  return serialized_error(std::string("its ") + kNames[name] + " is damaged");
}

}  // namespace kaamos::runtime
