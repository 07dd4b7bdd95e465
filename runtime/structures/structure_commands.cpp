// SPDX-License-Identifier: MIT
#include "runtime/structures/structure_commands.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <utility>

#include "runtime/backend/dispatch_checks.h"
#include "runtime/errors/text.h"
#include "runtime/structures/build_inputs.h"
#include "runtime/structures/micromap_inputs.h"
#include "runtime/structures/serialized_objects.h"
#include "runtime/structures/serialized_structure.h"

namespace kaamos::runtime {
namespace {

using rtapi::HasAny;
using Type = rtapi::RaytracingAccelerationStructureType;
using InfoType = rtapi::RaytracingAccelerationStructurePostbuildInfoType;

constexpr uint64_t kHeaderBytes = 256;

uint64_t round_up(uint64_t bytes) {
  return (bytes + 255) / 256 * 256;
}

// Embree's bytes per triangle, measured on a million of them and rounded up: SAH trees take 67,
// Morton ones 94, dynamic ones 102; plus 12 bytes for its indices. Lavapipe's tree takes 104.
uint64_t triangle_bytes(BuildFlags flags) {
  if (HasAny(flags, BuildFlags::kPreferFastBuild | BuildFlags::kAllowUpdate)) return 128;
  return HasAny(flags, BuildFlags::kMinimizeMemory) ? 72 : 96;
}

// The structure to update, or why it cannot be updated.
rtapi::Result<std::shared_ptr<const AccelerationStructure>> update_source(
    const StructureEnvironment& environment, const BuildCommand& command) {
  const AddressMap& addresses = *environment.context.addresses;
  auto source = environment.structures.find(command.source);
  if (source == nullptr || source->micromaps != nullptr || source->partitioned != nullptr ||
      source->is_cluster_object() ||
      (source->bottom_level != nullptr) != (command.type == Type::kBottomLevel)) {
    return make_error(Id::kUpdate, "there is no acceleration structure of this type " +
                                       at_address(addresses, command.source) + ".");
  }
  if (!HasAny(source->flags, BuildFlags::kAllowUpdate)) {
    return make_error(Id::kUpdate, "the structure " + at_address(addresses, command.source) +
                                       " was built without ALLOW_UPDATE.");
  }
  // For bottom levels check_update reports it.
  constexpr BuildFlags kMayDiffer = BuildFlags::kAllowUpdate | BuildFlags::kPerformUpdate;
  if (command.type == Type::kTopLevel &&
      (command.flags & ~kMayDiffer) != (source->flags & ~kMayDiffer)) {
    return make_error(Id::kUpdate, "build flags are " +
                                       std::to_string(static_cast<uint32_t>(command.flags)) +
                                       ", but the top level was built with " +
                                       std::to_string(static_cast<uint32_t>(source->flags)) +
                                       "; only ALLOW_UPDATE and PERFORM_UPDATE may differ.");
  }
  if (command.type == Type::kTopLevel && source->instance_count != command.instance_count) {
    return make_error(Id::kUpdate, "NumDescs is " + std::to_string(command.instance_count) +
                                       ", but the top level was built with " +
                                       std::to_string(source->instance_count) + ".");
  }
  return source;
}

rtapi::Status update_error(uint32_t geometry, const std::string& what) {
  return make_error(Id::kUpdate,
                    "geometry " + std::to_string(geometry) + ": " + what +
                        " differs from the build. Only vertex data, transforms and boxes may "
                        "change; build anew.");
}

rtapi::Status write_info(const StructureEnvironment& environment, uint64_t address, InfoType type,
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
    case InfoType::kSerialization: {
      const SerializedSize size = serialized_size(structure);
      values[0] = size.bytes;
      values[1] = size.pointers;
      break;
    }
    case InfoType::kToolsVisualization:
      values[0] = decoded_size(structure);
      break;
  }
  const AddressMap& addresses = *environment.context.addresses;
  if (!addresses.contains(address, bytes)) {
    return make_error(Id::kResultTooSmall, "postbuild info needs " + std::to_string(bytes) +
                                               " bytes " + at_address(addresses, address) + ".");
  }
  std::memcpy(addresses.host(address), values, bytes);
  return {};
}

// Copies of inputs are as large as the application wants, so running out of memory is its error.
rtapi::Status guarded(const BuildLevel& build_level, const AccelerationStructure* source,
                      AccelerationStructure& structure) {
  try {
    return build_level(source, structure);
  } catch (const std::bad_alloc&) {
    return make_error(Id::kOutOfMemory,
                      "copies of the inputs of the acceleration structure at address " +
                          errors::hex(structure.address) + " could not be allocated.");
  }
}

}  // namespace

rtapi::Status check_destination(const AddressMap& addresses, uint64_t address, uint64_t bytes) {
  const uint64_t available = addresses.bytes_from(address);
  if (bytes <= available) return {};
  return make_error(Id::kResultTooSmall, "an acceleration structure needs " +
                                             std::to_string(bytes) + " bytes " +
                                             at_address(addresses, address) +
                                             ", but the buffer has " + std::to_string(available) +
                                             " from there on. Size it by "
                                             "GetRaytracingAccelerationStructurePrebuildInfo.");
}

bool overlap(uint64_t a, uint64_t b, uint64_t bytes) {
  return (a > b ? a - b : b - a) < bytes;
}

uint64_t compacted_size(uint64_t size_bytes, uint64_t held_bytes) {
  return std::min(size_bytes, round_up(kHeaderBytes + held_bytes));
}

void StructureEnvironment::warn(Id id, const std::string& text) const {
  context.message(make_message(id, text));
}

rtapi::RaytracingAccelerationStructurePrebuildInfo estimate_sizes(const BuildCommand& inputs) {
  uint64_t bytes = kHeaderBytes;
  if (inputs.type == Type::kTopLevel) {
    // Two cache lines, the inverse transform, and Embree's 110 bytes in a tree of user geometry.
    bytes += uint64_t{inputs.instance_count} * 320;
  }
  for (const auto& entry : inputs.micromaps.histogram) {
    const uint64_t each =
        micromap_bytes(entry.SubdivisionLevel, static_cast<MicromapFormat>(entry.Format));
    bytes += entry.Count * (each + MicromapArray::kBytesEach);
  }
  for (size_t i = 0; i < inputs.geometries.size(); ++i) {
    const auto& geometry = inputs.geometries[i];
    const uint64_t primitives = primitive_count(geometry);
    bytes += 1024 + primitives * triangle_bytes(inputs.flags);
    if (!inputs.linkages.empty() && inputs.linkages[i]) bytes += primitives * sizeof(int32_t);
    if (geometry.Type == rtapi::RaytracingGeometryType::kTriangles) {
      bytes += primitives * 12 + uint64_t{geometry.Triangles.VertexCount} * 12;
    } else {
      bytes += primitives * sizeof(rtapi::RaytracingAabb);
    }
  }
  rtapi::RaytracingAccelerationStructurePrebuildInfo info;
  info.ResultDataMaxSizeInBytes = round_up(bytes);
  info.ScratchDataSizeInBytes = kHeaderBytes;
  info.UpdateScratchDataSizeInBytes =
      HasAny(inputs.flags, BuildFlags::kAllowUpdate) ? kHeaderBytes : 0;
  return info;
}

rtapi::Status build_structure(const StructureEnvironment& environment, const BuildCommand& command,
                              const BuildLevel& build_level) {
  const AddressMap& addresses = *environment.context.addresses;
  for (uint32_t i = 0; i < command.geometries.size(); ++i) {
    if (auto s = check_inputs(command.geometries[i], i, addresses); !s) return s;
  }
  std::shared_ptr<const AccelerationStructure> source;
  if (HasAny(command.flags, BuildFlags::kPerformUpdate)) {
    auto found = update_source(environment, command);
    if (!found) return found.error();
    source = *found;
  }
  auto linkages = read_linkages(environment, command);
  if (!linkages) return linkages.error();
  AccelerationStructure structure;
  structure.address = command.dest;
  structure.host = addresses.host(command.dest);
  structure.flags = command.flags & ~BuildFlags::kPerformUpdate;
  structure.instance_count = command.instance_count;
  // An update uses as much memory as its source, compacted or not. [DXR: BUILD_FLAGS
  // PERFORM_UPDATE]
  structure.size_bytes =
      source != nullptr ? source->size_bytes : estimate_sizes(command).ResultDataMaxSizeInBytes;
  if (auto s = check_destination(addresses, command.dest, structure.size_bytes); !s) return s;
  if (source != nullptr && command.dest != source->address &&
      overlap(command.dest, source->address, source->size_bytes)) {
    return make_error(Id::kUpdate, "source " + at_address(addresses, source->address) +
                                       " and destination " + at_address(addresses, command.dest) +
                                       " take " + std::to_string(source->size_bytes) +
                                       " bytes each and overlap. Update in place, or into other "
                                       "memory.");
  }
  if (command.type == Type::kOpacityMicromapArray) {
    const auto read = [&](const AccelerationStructure*, AccelerationStructure& result) {
      auto micromaps = read_micromaps(environment, command);
      if (!micromaps) return rtapi::Status(micromaps.error());
      result.micromaps = *micromaps;
      result.compacted_bytes = result.micromaps->held_bytes();
      return rtapi::Status();
    };
    if (auto s = guarded(read, nullptr, structure); !s) return s;
  } else {
    // Without the flag the linkages of the build stay. [DXR: ALLOW_OMM_LINKAGE_UPDATE]
    const bool keeps =
        source != nullptr && !HasAny(source->flags, BuildFlags::kAllowOmmLinkageUpdate);
    structure.linkages = keeps ? source->linkages : *std::move(linkages);
    if (auto s = guarded(build_level, source.get(), structure); !s) return s;
  }
  structure.compacted_bytes = source != nullptr
                                  ? source->compacted_bytes
                                  : compacted_size(structure.size_bytes, structure.compacted_bytes);
  if (command.type == Type::kTopLevel && structure.instances == nullptr) {
    structure.instances = std::make_shared<const std::vector<rtapi::RaytracingInstanceDesc>>();
  }
  environment.structures.place(structure);
  for (const auto& info : command.postbuild_infos) {
    uint64_t bytes = 0;
    if (auto s = write_info(environment, info.DestBuffer, info.InfoType, structure, bytes); !s) {
      return s;
    }
  }
  return {};
}

rtapi::Status emit_postbuild_info(
    const StructureEnvironment& environment,
    const rtapi::RaytracingAccelerationStructurePostbuildInfoDesc& desc,
    std::span<const uint64_t> sources) {
  uint64_t address = desc.DestBuffer;
  for (const uint64_t source : sources) {
    const auto structure = environment.structures.find(source);
    if (structure == nullptr) {
      return make_error(Id::kStructureSource,
                        "postbuild info is requested, but there is no acceleration structure " +
                            at_address(*environment.context.addresses, source) + ".");
    }
    const bool any_has =
        desc.InfoType == InfoType::kSerialization || desc.InfoType == InfoType::kToolsVisualization;
    if (is_object(*structure) && !any_has) {
      return make_error(Id::kStructureSource,
                        "what an operation made " +
                            at_address(*environment.context.addresses, source) +
                            " has no postbuild info but kSerialization and kToolsVisualization.");
    }
    uint64_t bytes = 0;
    if (auto s = write_info(environment, address, desc.InfoType, *structure, bytes); !s) return s;
    address += bytes;
  }
  return {};
}

rtapi::Status check_primitive_count(const rtapi::RaytracingGeometryDesc& desc, uint32_t index) {
  if (primitive_count(desc) <= rtapi::kRaytracingMaxPrimitivesPerBottomLevelAccelerationStructure) {
    return {};
  }
  return make_error(Id::kTooManyElements,
                    "geometry " + std::to_string(index) + " has " +
                        std::to_string(primitive_count(desc)) +
                        " primitives, but a bottom level holds at most 2^29.");
}

rtapi::Status check_update(std::span<const GeometryShape> built, BuildFlags built_flags,
                           std::span<const rtapi::RaytracingGeometryDesc> geometries,
                           BuildFlags flags, const std::vector<bool>& linked) {
  constexpr BuildFlags kMayDiffer = BuildFlags::kAllowUpdate | BuildFlags::kPerformUpdate;
  if (!HasAny(built_flags, BuildFlags::kAllowUpdate)) {
    return make_error(Id::kUpdate, "the bottom level was built without ALLOW_UPDATE.");
  }
  if ((flags & ~kMayDiffer) != (built_flags & ~kMayDiffer)) {
    return make_error(Id::kUpdate, "build flags are " +
                                       std::to_string(static_cast<uint32_t>(flags)) +
                                       ", but the bottom level was built with " +
                                       std::to_string(static_cast<uint32_t>(built_flags)) +
                                       "; only ALLOW_UPDATE and PERFORM_UPDATE may differ.");
  }
  if (geometries.size() != built.size()) {
    return make_error(Id::kUpdate, "there are " + std::to_string(geometries.size()) +
                                       " geometries, but the bottom level was built with " +
                                       std::to_string(built.size()) + "; build anew.");
  }
  for (uint32_t i = 0; i < geometries.size(); ++i) {
    const GeometryShape& was = built[i];
    GeometryShape is = shape_of(geometries[i], i);
    is.linked = i < linked.size() && linked[i];
    if (is.type != was.type) return update_error(i, "its type");
    if (is.primitives != was.primitives || is.vertices != was.vertices) {
      return update_error(i, "its count (" + std::to_string(is.primitives) + " primitives and " +
                                 std::to_string(is.vertices) + " vertices, built with " +
                                 std::to_string(was.primitives) + " and " +
                                 std::to_string(was.vertices) + ")");
    }
    if (is.vertex_format != was.vertex_format || is.index_format != was.index_format) {
      return update_error(i, "its format");
    }
    if (is.opaque != was.opaque || is.no_duplicate_any_hit != was.no_duplicate_any_hit) {
      return update_error(i, "one of its flags");
    }
    if (is.linked != was.linked) return update_error(i, "its type (with or without micromaps)");
    if (is.transformed != was.transformed) return update_error(i, "Transform3x4 (null or not)");
  }
  return {};
}

void warn_out_of_range(const StructureEnvironment& environment, uint64_t address,
                       uint64_t triangles) {
  if (triangles == 0) return;
  environment.warn(Id::kIndexOutOfRange,
                   "bottom level " + at_address(*environment.context.addresses, address) + ": " +
                       std::to_string(triangles) +
                       " triangles have an index past VertexCount and are never hit.");
}

}  // namespace kaamos::runtime
