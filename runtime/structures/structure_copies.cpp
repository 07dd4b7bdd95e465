// SPDX-License-Identifier: MIT
#include "runtime/structures/structure_copies.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "runtime/backend/dispatch_checks.h"
#include "runtime/backend/errors.h"
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
  result.missing_bottom_levels = count_missing(environment.structures, *result.instances);
  return rebuild.top_level(
      activate_instances(environment, result.address, *result.instances, notes), result);
}

rtapi::Status place(const StructureEnvironment& environment, AccelerationStructure result) {
  if (result.micromaps == nullptr &&
      result.address % rtapi::kRaytracingAccelerationStructureByteAlignment != 0) {
    return make_error(Id::kStructureSource,
                      "the copy " + at_address(*environment.context.addresses, result.address) +
                          " is no micromap array; its address must be a multiple of 256.");
  }
  if (auto s = check_destination(*environment.context.addresses, result.address, result.size_bytes);
      !s) {
    return s;
  }
  environment.structures.place(std::move(result));
  return {};
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
  if (parsed->type == Type::kOpacityMicromapArray) {
    result.micromaps = parsed->micromaps;
    result.compacted_bytes = result.micromaps->held_bytes();
  } else if (parsed->type == Type::kBottomLevel) {
    result.linkages = std::move(parsed->linkages);
    if (auto s = rebuild.bottom_level(parsed->geometries, parsed->shapes, result); !s) return s;
  } else {
    for (uint32_t i = 0; i < parsed->instances.size(); ++i) {
      const uint64_t address = parsed->instances[i].AccelerationStructure;
      if (address == 0 || addresses.bytes_from(address) != 0) continue;
      return make_error(Id::kSerializedData,
                        "the bottom level of instance " + std::to_string(i) + " is " +
                            at_address(addresses, address) +
                            ". Write the addresses of the bottom levels after the header first.");
    }
    result.instance_count = static_cast<uint32_t>(parsed->instances.size());
    result.instances = std::make_shared<const std::vector<rtapi::RaytracingInstanceDesc>>(
        std::move(parsed->instances));
    if (auto s = build_top_level(environment, rebuild, InstanceNotes::kMissingMayCome, result); !s)
      return s;
  }
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
  if (source->partitioned != nullptr) {
    return make_error(Id::kStructureSource,
                      "the partitioned top level " + at_address(addresses, command.source) +
                          " cannot be copied; an operation with it as the source and another "
                          "destination makes a second one.");
  }
  if (source->is_cluster_object()) {
    return make_error(Id::kStructureSource, "what an operation on clusters made " +
                                                at_address(addresses, command.source) +
                                                " cannot be copied or serialized.");
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

rtapi::Status complete_top_levels(const StructureEnvironment& environment,
                                  const RebuildLevel& rebuild) {
  for (const auto& placed : environment.structures.incomplete_top_levels()) {
    const uint32_t missing = count_missing(environment.structures, *placed->instances);
    if (missing == placed->missing_bottom_levels && placed->missing_reported) continue;
    AccelerationStructure result = *placed;
    result.missing_reported = true;
    const auto notes =
        placed->missing_reported ? InstanceNotes::kMissingMayCome : InstanceNotes::kAll;
    try {
      if (auto s = build_top_level(environment, rebuild, notes, result); !s) return s;
    } catch (const std::bad_alloc&) {
      return out_of_memory("the deserialized top level " +
                           at_address(*environment.context.addresses, placed->address));
    }
    result.compacted_bytes = compacted_size(result.size_bytes, result.compacted_bytes);
    environment.structures.place(std::move(result));
  }
  return {};
}

}  // namespace kaamos::runtime
