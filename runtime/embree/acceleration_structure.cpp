// SPDX-License-Identifier: MIT
#include "runtime/embree/acceleration_structure.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/embree/build_inputs.h"
#include "runtime/embree/device.h"

namespace kaamos::embree {
namespace {

using rtapi::HasAny;
using Type = rtapi::RaytracingAccelerationStructureType;
using InfoType = rtapi::RaytracingAccelerationStructurePostbuildInfoType;
using CopyMode = rtapi::RaytracingAccelerationStructureCopyMode;

constexpr uint64_t kHeaderBytes = 256;

uint64_t round_up(uint64_t bytes) {
  return (bytes + 255) / 256 * 256;
}

// Embree's bytes for one triangle, measured on a million of them, and rounded up: SAH trees take
// 67, Morton ones 94, dynamic ones 102; then 12 bytes for its indices.
uint64_t triangle_bytes(BuildFlags flags) {
  if (HasAny(flags, BuildFlags::kPreferFastBuild | BuildFlags::kAllowUpdate)) return 128;
  return HasAny(flags, BuildFlags::kMinimizeMemory) ? 72 : 96;
}

std::string at(uint64_t address) {
  return "at address " + std::to_string(address);
}

rtapi::Error build_error(const char* id, const std::string& what) {
  return {id, rtapi::ErrorCode::kInvalidArgument, std::string(id) + " " + what};
}

rtapi::Status check_destination(Device& device, uint64_t address, uint64_t bytes) {
  const uint64_t available = device.context().addresses->bytes_from(address);
  if (bytes <= available) return {};
  return build_error("KA0795", "acceleration structure does not fit: " + std::to_string(bytes) +
                                   " bytes " + at(address) + ", its buffer has " +
                                   std::to_string(available) +
                                   " from there. Size it by "
                                   "GetRaytracingAccelerationStructurePrebuildInfo.");
}

rtapi::Result<std::vector<rtapi::RaytracingInstanceDesc>> read_instances(
    Device& device, const runtime::BuildCommand& command) {
  constexpr uint64_t kBytes = sizeof(rtapi::RaytracingInstanceDesc);
  const runtime::AddressMap& addresses = *device.context().addresses;
  std::vector<rtapi::RaytracingInstanceDesc> instances(command.instance_count);
  if (command.instance_count == 0) return instances;
  const bool pointers = command.instance_layout == rtapi::ElementsLayout::kArrayOfPointers;
  const uint64_t wanted = uint64_t{command.instance_count} * (pointers ? 8 : kBytes);
  if (!addresses.contains(command.instance_descs, wanted)) {
    return build_error(
        "KA0796", "instance descs outside their buffer: " + std::to_string(command.instance_count) +
                      " of them " + at(command.instance_descs) + " need " + std::to_string(wanted) +
                      " bytes, there are " +
                      std::to_string(addresses.bytes_from(command.instance_descs)) + ".");
  }
  if (!pointers) {
    std::memcpy(instances.data(), reinterpret_cast<const void*>(command.instance_descs), wanted);
    return instances;
  }
  const auto* each = reinterpret_cast<const uint64_t*>(command.instance_descs);
  for (uint32_t i = 0; i < command.instance_count; ++i) {
    if (!addresses.contains(each[i], kBytes)) {
      return build_error("KA0796", "instance desc " + std::to_string(i) + " " + at(each[i]) +
                                       " is in no living buffer.");
    }
    std::memcpy(&instances[i], reinterpret_cast<const void*>(each[i]), kBytes);
  }
  return instances;
}

rtapi::Status build_top_level(Device& device, const runtime::BuildCommand& command,
                              AccelerationStructure& structure) {
  auto instances = read_instances(device, command);
  if (!instances) return instances.error();
  std::vector<std::string> notes;
  const FindBottomLevel find = [](const void* self, uint64_t address) {
    return static_cast<const Memory*>(self)->find_bottom_level(address);
  };
  auto level = TopLevel::build(device.build_context(), *instances, find, &device.memory(), notes);
  if (!level) return level.error();
  constexpr size_t kMostNotes = 8;
  for (size_t i = 0; i < std::min(notes.size(), kMostNotes); ++i) {
    device.warn("KA0797", "top level " + at(command.dest) + ", " + notes[i] + ".");
  }
  structure.top_level = *level;
  structure.instance_count = command.instance_count;
  return {};
}

// The structure to update, or why it cannot be.
rtapi::Result<std::shared_ptr<const AccelerationStructure>> update_source(
    Device& device, const runtime::BuildCommand& command) {
  auto source = device.memory().find(command.source);
  if (source == nullptr ||
      (source->bottom_level != nullptr) != (command.type == Type::kBottomLevel)) {
    return build_error("KA0793",
                       "update from a source that is no acceleration structure of this "
                       "type, " +
                           at(command.source) + ".");
  }
  if (!HasAny(source->flags, BuildFlags::kAllowUpdate)) {
    return build_error("KA0793",
                       "update of an acceleration structure that was built without "
                       "ALLOW_UPDATE, " +
                           at(command.source) + ".");
  }
  if (command.type == Type::kTopLevel && source->instance_count != command.instance_count) {
    return build_error("KA0793", "update of a top level changes NumDescs from " +
                                     std::to_string(source->instance_count) + " to " +
                                     std::to_string(command.instance_count) + ".");
  }
  return source;
}

rtapi::Status build_bottom_level(Device& device, const runtime::BuildCommand& command,
                                 const AccelerationStructure* source,
                                 AccelerationStructure& structure) {
  if (source == nullptr) {
    auto level = BottomLevel::build(device.build_context(), command.geometries, command.flags);
    if (!level) return level.error();
    structure.bottom_level = *level;
    if ((*level)->out_of_range_triangles() != 0) {
      device.warn("KA0798", "bottom level " + at(command.dest) + ": " +
                                std::to_string((*level)->out_of_range_triangles()) +
                                " triangles have an index past VertexCount and are never hit.");
    }
    return {};
  }
  const auto& level = source->bottom_level;
  if (auto s = level->check_update(command.geometries, command.flags); !s) return s;
  const bool in_place = command.source == command.dest;
  if (in_place && !device.memory().is_shared(level.get())) {
    structure.bottom_level = level;
    return level->update(device.build_context(), command.geometries);
  }
  auto updated = level->updated_copy(device.build_context(), command.geometries);
  if (!updated) return updated.error();
  structure.bottom_level = *updated;
  return {};
}

rtapi::Status write_info(Device& device, uint64_t address, InfoType type,
                         const AccelerationStructure& structure, uint64_t& bytes) {
  uint64_t values[2] = {0, 0};
  bytes = type == InfoType::kSerialization ? 16 : 8;
  switch (type) {
    case InfoType::kCompactedSize:
      values[0] = structure.compacted_bytes;
      break;
    case InfoType::kCurrentSize:
      values[0] = structure.size_bytes;
      break;
    default:
      device.warn("KA0799", "postbuild info type " + std::to_string(static_cast<uint32_t>(type)) +
                                " is not supported on the Embree backend and gives 0.");
      break;
  }
  if (!device.context().addresses->contains(address, bytes)) {
    return build_error("KA0795", "postbuild info does not fit: " + std::to_string(bytes) +
                                     " bytes " + at(address) + " are in no living buffer.");
  }
  std::memcpy(reinterpret_cast<void*>(address), values, bytes);
  return {};
}

}  // namespace

rtapi::RaytracingAccelerationStructurePrebuildInfo estimate_sizes(
    Type type, BuildFlags flags, std::span<const rtapi::RaytracingGeometryDesc> geometries,
    uint32_t instance_count) {
  uint64_t bytes = kHeaderBytes;
  if (type == Type::kTopLevel) {
    // Two cache lines, the inverse transform, and Embree's 110 bytes in a tree of user geometry.
    bytes += uint64_t{instance_count} * 320;
  }
  for (const auto& geometry : geometries) {
    const uint64_t primitives = primitive_count(geometry);
    bytes += 1024 + primitives * triangle_bytes(flags);
    if (geometry.Type == rtapi::RaytracingGeometryType::kTriangles) {
      bytes += primitives * 12 + uint64_t{geometry.Triangles.VertexCount} * 12;
    } else {
      bytes += primitives * sizeof(rtapi::RaytracingAabb);
    }
  }
  rtapi::RaytracingAccelerationStructurePrebuildInfo info;
  info.ResultDataMaxSizeInBytes = round_up(bytes);
  info.ScratchDataSizeInBytes = kHeaderBytes;
  info.UpdateScratchDataSizeInBytes = HasAny(flags, BuildFlags::kAllowUpdate) ? kHeaderBytes : 0;
  return info;
}

rtapi::Status build(Device& device, const runtime::BuildCommand& command) {
  for (uint32_t i = 0; i < command.geometries.size(); ++i) {
    if (auto s = check_inputs(command.geometries[i], i, *device.context().addresses); !s) return s;
  }
  std::shared_ptr<const AccelerationStructure> source;
  if (HasAny(command.flags, BuildFlags::kPerformUpdate)) {
    auto found = update_source(device, command);
    if (!found) return found.error();
    source = *found;
  }
  AccelerationStructure structure;
  structure.address = command.dest;
  structure.flags = command.flags & ~BuildFlags::kPerformUpdate;
  // An update takes the memory of its source, compacted or not. [DXR: BUILD_FLAGS PERFORM_UPDATE]
  structure.size_bytes =
      source != nullptr
          ? source->size_bytes
          : estimate_sizes(command.type, command.flags, command.geometries, command.instance_count)
                .ResultDataMaxSizeInBytes;
  if (auto s = check_destination(device, command.dest, structure.size_bytes); !s) return s;

  const int64_t before = device.embree_bytes();
  rtapi::Status status;
  device.arena().execute([&] {
    status = command.type == Type::kTopLevel
                 ? build_top_level(device, command, structure)
                 : build_bottom_level(device, command, source.get(), structure);
  });
  if (!status) return status;
  const auto held = static_cast<uint64_t>(std::max<int64_t>(device.embree_bytes() - before, 0));
  structure.compacted_bytes = source != nullptr
                                  ? source->compacted_bytes
                                  : std::min(structure.size_bytes, round_up(kHeaderBytes + held));
  device.memory().place(structure);
  for (const auto& info : command.postbuild_infos) {
    uint64_t bytes = 0;
    if (auto s = write_info(device, info.DestBuffer, info.InfoType, structure, bytes); !s) return s;
  }
  return {};
}

rtapi::Status copy(Device& device, const runtime::CopyAccelerationStructureCommand& command) {
  const auto source = device.memory().find(command.source);
  if (source == nullptr) {
    return build_error("KA0796",
                       "copy of what is no acceleration structure, " + at(command.source) + ".");
  }
  if (command.mode != CopyMode::kClone && command.mode != CopyMode::kCompact) {
    device.warn("KA0799", "acceleration structure copy mode " +
                              std::to_string(static_cast<uint32_t>(command.mode)) +
                              " is not supported on the Embree backend; nothing was copied.");
    return {};
  }
  AccelerationStructure result = *source;
  result.address = command.dest;
  if (command.mode == CopyMode::kCompact) {
    if (!HasAny(source->flags, BuildFlags::kAllowCompaction)) {
      return build_error("KA0796",
                         "compaction of an acceleration structure that was built without "
                         "ALLOW_COMPACTION, " +
                             at(command.source) + ".");
    }
    result.size_bytes = source->compacted_bytes;
  }
  if (auto s = check_destination(device, command.dest, result.size_bytes); !s) return s;
  // Both refer to the same immutable tree; an update in place of one of them makes a tree of its
  // own first.
  device.memory().place(std::move(result));
  return {};
}

rtapi::Status emit_postbuild_info(
    Device& device, const rtapi::RaytracingAccelerationStructurePostbuildInfoDesc& desc,
    std::span<const uint64_t> sources) {
  uint64_t address = desc.DestBuffer;
  for (const uint64_t source : sources) {
    const auto structure = device.memory().find(source);
    if (structure == nullptr) {
      return build_error(
          "KA0796", "postbuild info of what is no acceleration structure, " + at(source) + ".");
    }
    uint64_t bytes = 0;
    if (auto s = write_info(device, address, desc.InfoType, *structure, bytes); !s) return s;
    address += bytes;
  }
  return {};
}

}  // namespace kaamos::embree
