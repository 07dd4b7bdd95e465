// SPDX-License-Identifier: MIT
#include "runtime/structures/structure_copies.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <unordered_set>
#include <utility>

#include "runtime/backend/dispatch_checks.h"
#include "runtime/backend/errors.h"
#include "runtime/structures/clustered_level.h"
#include "runtime/structures/partitioned_instances.h"
#include "runtime/structures/serialized_objects.h"
#include "runtime/structures/serialized_structure.h"

namespace kaamos::runtime {
namespace {

using CopyMode = rtapi::RaytracingAccelerationStructureCopyMode;
using Type = rtapi::RaytracingAccelerationStructureType;

rtapi::Error out_of_memory(const std::string& what) {
  return make_error(Id::kOutOfMemory, what + " could not be allocated.");
}

// The host bytes to write for serialization and tools.
rtapi::Result<std::span<uint8_t>> output(const StructureEnvironment& environment,
                                         const CopyAccelerationStructureCommand& command,
                                         uint64_t bytes, const char* what, const char* info_type) {
  const AddressMap& addresses = *environment.context.addresses;
  const uint64_t available = addresses.bytes_from(command.dest);
  if (bytes > available) {
    return make_error(Id::kResultTooSmall, std::string(what) + " needs " + std::to_string(bytes) +
                                               " bytes " + at_address(addresses, command.dest) +
                                               ", but the buffer has " + std::to_string(available) +
                                               " from there on. Size it by postbuild info " +
                                               info_type + ".");
  }
  environment.structures.evict(command.dest, bytes);
  return std::span<uint8_t>(addresses.host(command.dest), bytes);
}

uint32_t count_missing(const StructureMap& structures,
                       std::span<const rtapi::RaytracingInstanceDesc> instances) {
  return static_cast<uint32_t>(
      std::count_if(instances.begin(), instances.end(), [&](const auto& instance) {
        if (instance.AccelerationStructure == 0) return false;
        const auto structure = structures.find(instance.AccelerationStructure);
        return structure == nullptr || structure->bottom_level == nullptr;
      }));
}

rtapi::Status build_top_level(const StructureEnvironment& environment, const RebuildLevel& rebuild,
                              InstanceNotes notes, AccelerationStructure& result) {
  result.missing = count_missing(environment.structures, *result.instances);
  return rebuild.top_level(
      activate_instances(environment, result.address, *result.instances, notes), result);
}

// Of `level`, as it was last set. The result has a copy of its own.
rtapi::Status build_partitioned_top_level(const StructureEnvironment& environment,
                                          const RebuildLevel& rebuild, InstanceNotes notes,
                                          const PartitionedTopLevel& from,
                                          AccelerationStructure& result) {
  auto level = std::make_shared<PartitionedTopLevel>(from);
  std::vector<uint32_t> all(level->slots.size());
  result.missing = 0;
  for (uint32_t i = 0; i < all.size(); ++i) {
    all[i] = i;
    const char* why = activate(environment.structures, *level, i);
    const rtapi::RaytracingInstanceDesc& desc = level->instances[i].desc;
    const bool missing = count_missing(environment.structures, {&desc, 1}) != 0;
    if (missing) ++result.missing;
    if (why == nullptr || (missing && notes == InstanceNotes::kMissingMayCome)) continue;
    environment.warn(Id::kInstanceInactive,
                     "the partitioned top level " +
                         at_address(*environment.context.addresses, result.address) +
                         ", instance " + std::to_string(i) + ": " + why + ".");
  }
  result.top_level = nullptr;
  if (auto s = build_partitioned_level(rebuild, *level, all, result); !s) return s;
  result.partitioned = std::move(level);
  return {};
}

rtapi::Status build_level_of_clusters(const StructureEnvironment& environment,
                                      const RebuildLevel& rebuild, AccelerationStructure& result) {
  const Clusters found = find_clusters(environment.structures, *result.clusters, result.missing);
  return build_clustered_level(found, rebuild, result);
}

uint64_t alignment_of(const AccelerationStructure& structure) {
  if (structure.cluster_template != nullptr) return rtapi::kRtasClusterTemplateByteAlignment;
  const bool small = structure.micromaps != nullptr || structure.cluster != nullptr;
  return small ? rtapi::kRaytracingOpacityMicromapArrayByteAlignment
               : rtapi::kRaytracingAccelerationStructureByteAlignment;
}

rtapi::Status place(const StructureEnvironment& environment, AccelerationStructure result) {
  const uint64_t alignment = alignment_of(result);
  if (result.address % alignment != 0) {
    return make_error(Id::kStructureSource,
                      "the copy would be " +
                          at_address(*environment.context.addresses, result.address) +
                          "; of such a structure the address must be a multiple of " +
                          std::to_string(alignment) + ".");
  }
  if (auto s = check_destination(*environment.context.addresses, result.address, result.size_bytes);
      !s) {
    return s;
  }
  environment.structures.place(std::move(result));
  return {};
}

// The addresses that the application has to write after the header must at least be in buffers.
rtapi::Status check_pointers(const AddressMap& addresses, std::span<const uint64_t> pointers,
                             const char* what) {
  for (size_t i = 0; i < pointers.size(); ++i) {
    if (pointers[i] == 0 || addresses.bytes_from(pointers[i]) != 0) continue;
    return make_error(Id::kSerializedData,
                      std::string(what) + std::to_string(i) + " is " +
                          at_address(addresses, pointers[i]) +
                          ". Write the addresses of the copies after the header first.");
  }
  return {};
}

// What was parsed, as a structure without a place.
rtapi::Status make_level(const StructureEnvironment& environment, SerializedStructure& parsed,
                         const RebuildLevel& rebuild, AccelerationStructure& result) {
  const AddressMap& addresses = *environment.context.addresses;
  std::vector<uint64_t> pointers;
  switch (parsed.type) {
    case Type::kOpacityMicromapArray:
      result.micromaps = parsed.micromaps;
      result.compacted_bytes = result.micromaps->held_bytes();
      return {};
    case Type::kClusterLevel:
    case Type::kClusterTemplate:
      result.cluster = parsed.cluster;
      result.cluster_template = parsed.cluster_template;
      result.linkages = std::move(parsed.linkages);
      return {};
    case Type::kBottomLevel:
      result.linkages = std::move(parsed.linkages);
      return rebuild.bottom_level(parsed.geometries, parsed.shapes, result);
    case Type::kClusteredBottomLevel:
      if (auto s = check_pointers(addresses, parsed.clusters, "cluster "); !s) return s;
      result.clusters = std::make_shared<const std::vector<uint64_t>>(std::move(parsed.clusters));
      return build_level_of_clusters(environment, rebuild, result);
    case Type::kPartitionedTopLevel:
      for (const auto& slot : parsed.partitioned->slots) {
        pointers.push_back(slot.args.AccelerationStructure);
      }
      if (auto s = check_pointers(addresses, pointers, "the bottom level of instance "); !s) {
        return s;
      }
      result.instance_count = static_cast<uint32_t>(pointers.size());
      return build_partitioned_top_level(environment, rebuild, InstanceNotes::kMissingMayCome,
                                         *parsed.partitioned, result);
    case Type::kTopLevel:
      break;
  }
  for (const auto& instance : parsed.instances) pointers.push_back(instance.AccelerationStructure);
  if (auto s = check_pointers(addresses, pointers, "the bottom level of instance "); !s) return s;
  result.instance_count = static_cast<uint32_t>(parsed.instances.size());
  result.instances = std::make_shared<const std::vector<rtapi::RaytracingInstanceDesc>>(
      std::move(parsed.instances));
  return build_top_level(environment, rebuild, InstanceNotes::kMissingMayCome, result);
}

rtapi::Status deserialize(const StructureEnvironment& environment,
                          const CopyAccelerationStructureCommand& command,
                          const RebuildLevel& rebuild) {
  const AddressMap& addresses = *environment.context.addresses;
  // Works on a copy, since shaders of another queue may be writing; and copies no more than the
  // header says.
  uint64_t size = sizeof(rtapi::SerializedRaytracingAccelerationStructureHeader);
  const uint64_t available = addresses.bytes_from(command.source);
  if (available >= size) {
    rtapi::SerializedRaytracingAccelerationStructureHeader header;
    std::memcpy(&header, addresses.host(command.source), sizeof(header));
    size = std::max(size, header.SerializedSizeInBytesIncludingHeader);
  }
  size = std::min(size, available);
  std::vector<uint8_t> bytes(size);
  if (size != 0) std::memcpy(bytes.data(), addresses.host(command.source), size);
  auto parsed = parse_serialized(bytes);
  if (!parsed) return parsed.error();
  const bool micromaps = parsed->micromaps != nullptr || !parsed->linkages.empty();
  if (micromaps && !environment.has_micromaps) {
    return make_error(Id::kSerializedData, std::string("it has opacity micromaps, which backend ") +
                                               environment.backend_name + " has not.");
  }

  AccelerationStructure result;
  result.address = command.dest;
  result.host = addresses.host(command.dest);
  result.flags = parsed->flags;
  result.size_bytes = parsed->size_bytes;
  if (auto s = check_destination(addresses, command.dest, result.size_bytes); !s) return s;
  if (auto s = make_level(environment, *parsed, rebuild, result); !s) return s;
  result.compacted_bytes = compacted_size(result.size_bytes, result.compacted_bytes);
  return place(environment, std::move(result));
}

rtapi::Status copy(const StructureEnvironment& environment,
                   const CopyAccelerationStructureCommand& command, const RebuildLevel& rebuild) {
  if (command.mode == CopyMode::kDeserialize) return deserialize(environment, command, rebuild);
  const AddressMap& addresses = *environment.context.addresses;
  const auto source = environment.structures.find(command.source);
  if (source == nullptr) {
    return make_error(Id::kStructureSource, "there is no acceleration structure " +
                                                at_address(addresses, command.source) + ".");
  }
  if (command.mode == CopyMode::kSerialize) {
    auto out = output(environment, command, serialized_size(*source).bytes,
                      "the serialized acceleration structure", "kSerialization");
    if (!out) return out.error();
    serialize(*source, *out);
    return {};
  }
  if (command.mode == CopyMode::kVisualizationDecodeForTools) {
    auto out = output(environment, command, decoded_size(*source),
                      "the decoded acceleration structure", "kToolsVisualization");
    if (!out) return out.error();
    decode_for_tools(*source, command.dest, *out);
    return {};
  }
  if (is_object(*source)) {
    return make_error(Id::kStructureSource,
                      "what an operation made " + at_address(addresses, command.source) +
                          " cannot be cloned or compacted; " +
                          (source->partitioned != nullptr
                               ? "an operation with it as the source and another destination makes "
                                 "a second one."
                               : "kMoveClusterObjects makes copies."));
  }
  AccelerationStructure result = *source;
  result.address = command.dest;
  result.host = environment.context.addresses->host(command.dest);
  if (command.mode == CopyMode::kCompact) {
    if (!rtapi::HasAny(source->flags, BuildFlags::kAllowCompaction)) {
      return make_error(Id::kStructureSource,
                        "the acceleration structure " + at_address(addresses, command.source) +
                            " cannot be compacted: it was built without ALLOW_COMPACTION.");
    }
    result.size_bytes = source->compacted_bytes;
  }
  // The source is at least as long as the copy.
  const uint64_t clear = command.dest > command.source ? source->size_bytes : result.size_bytes;
  if (overlap(command.dest, command.source, clear)) {
    return make_error(Id::kStructureSource,
                      "the acceleration structure " + at_address(addresses, command.source) +
                          " overlaps its copy " + at_address(addresses, command.dest) +
                          ". Copy into other memory.");
  }
  // Both refer to the same immutable tree; updating one of them in place first makes it a tree of
  // its own.
  return place(environment, std::move(result));
}

}  // namespace

rtapi::Status copy_structure(const StructureEnvironment& environment,
                             const CopyAccelerationStructureCommand& command,
                             const RebuildLevel& rebuild) {
  try {
    return copy(environment, command, rebuild);
  } catch (const std::bad_alloc&) {
    return out_of_memory("a copy of the acceleration structure " +
                         at_address(*environment.context.addresses, command.source));
  }
}

namespace {

// Bottom levels whose clusters came after them; `completed` gets their addresses.
rtapi::Status complete_bottom_levels(const StructureEnvironment& environment,
                                     const RebuildLevel& rebuild,
                                     std::unordered_set<uint64_t>& completed) {
  for (const auto& placed : environment.structures.incomplete()) {
    if (!placed->of_clusters) continue;
    uint32_t missing = 0;
    find_clusters(environment.structures, *placed->clusters, missing);
    if (missing == placed->missing && placed->missing_reported) continue;
    AccelerationStructure result = *placed;
    if (missing != 0 && !placed->missing_reported) {
      environment.warn(Id::kOperationArgument,
                       "the bottom level that was deserialized " +
                           at_address(*environment.context.addresses, placed->address) + " lacks " +
                           std::to_string(missing) + " of its " +
                           std::to_string(placed->clusters->size()) +
                           " clusters; deserialize or build them before it is traced.");
    }
    result.missing_reported = true;
    if (auto s = build_level_of_clusters(environment, rebuild, result); !s) return s;
    environment.structures.place(std::move(result));
    completed.insert(placed->address);
  }
  return {};
}

bool refers_to(const AccelerationStructure& top_level, const std::unordered_set<uint64_t>& levels) {
  bool found = false;
  for_each_instance(top_level, [&](const rtapi::RaytracingInstanceDesc& desc, uint32_t) {
    found |= levels.contains(desc.AccelerationStructure);
  });
  return found;
}

uint32_t count_missing(const StructureMap& structures, const AccelerationStructure& top_level) {
  uint32_t count = 0;
  for_each_instance(top_level, [&](const rtapi::RaytracingInstanceDesc& desc, uint32_t) {
    count += count_missing(structures, std::span(&desc, 1));
  });
  return count;
}

rtapi::Status rebuild_top_level(const StructureEnvironment& environment,
                                const AccelerationStructure& placed, const RebuildLevel& rebuild) {
  AccelerationStructure result = placed;
  result.missing_reported = true;
  const auto notes = placed.missing_reported ? InstanceNotes::kMissingMayCome : InstanceNotes::kAll;
  const rtapi::Status s =
      placed.partitioned != nullptr
          ? build_partitioned_top_level(environment, rebuild, notes, *placed.partitioned, result)
          : build_top_level(environment, rebuild, notes, result);
  if (!s) return s;
  result.compacted_bytes = compacted_size(result.size_bytes, result.compacted_bytes);
  environment.structures.place(std::move(result));
  return {};
}

rtapi::Status complete(const StructureEnvironment& environment, const RebuildLevel& rebuild) {
  const auto incomplete = environment.structures.incomplete();
  if (incomplete.empty()) return {};
  std::unordered_set<uint64_t> completed;
  if (auto s = complete_bottom_levels(environment, rebuild, completed); !s) return s;
  for (const auto& placed : environment.structures.top_levels()) {
    const bool changed =
        placed->missing != 0 && (!placed->missing_reported ||
                                 count_missing(environment.structures, *placed) != placed->missing);
    if (!changed && (completed.empty() || !refers_to(*placed, completed))) continue;
    if (auto s = rebuild_top_level(environment, *placed, rebuild); !s) return s;
  }
  return {};
}

}  // namespace

rtapi::Status complete_structures(const StructureEnvironment& environment,
                                  const RebuildLevel& rebuild) {
  try {
    return complete(environment, rebuild);
  } catch (const std::bad_alloc&) {
    return out_of_memory("a structure that was deserialized before what it refers to");
  }
}

}  // namespace kaamos::runtime
