// SPDX-License-Identifier: MIT
#include "runtime/checks/structures.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "runtime/checks/names.h"

namespace kaamos::checks {
namespace {

using rtapi::HasAny;
using runtime::BuildFlags;
using Type = rtapi::RaytracingAccelerationStructureType;

// At most this many structures that no longer exist are remembered.
constexpr size_t kMostGone = 4096;

}  // namespace

std::vector<rtapi::RaytracingInstanceDesc> Structures::read_instances(
    const runtime::BuildCommand& command) const {
  std::vector<rtapi::RaytracingInstanceDesc> out;
  if (command.type != Type::kTopLevel || command.instance_count == 0) return out;
  const bool pointers = command.instance_layout == rtapi::ElementsLayout::kArrayOfPointers;
  const uint64_t element = pointers ? 8 : sizeof(rtapi::RaytracingInstanceDesc);
  if (!addresses_.contains(command.instance_descs, command.instance_count * element)) return out;
  const uint8_t* host = addresses_.host(command.instance_descs);
  out.resize(command.instance_count);
  for (uint32_t i = 0; i < command.instance_count; ++i) {
    const uint8_t* record = host + i * element;
    if (pointers) {
      uint64_t address;
      std::memcpy(&address, record, sizeof address);
      if (!addresses_.contains(address, sizeof out[i])) continue;
      record = addresses_.host(address);
    }
    std::memcpy(static_cast<void*>(&out[i]), record, sizeof out[i]);
  }
  return out;
}

void Structures::end_in(uint64_t address, uint64_t size_bytes, uint64_t by) {
  auto it = structures_.lower_bound(address);
  if (it != structures_.begin()) {
    const auto before = std::prev(it);
    if (address - before->first < before->second.size_bytes) it = before;
  }
  while (it != structures_.end() && (it->first < address || it->first - address < size_bytes)) {
    if (gone_.size() > kMostGone) gone_.clear();
    gone_[it->first] = {std::move(it->second), by};
    it = structures_.erase(it);
    ++next_version_;
  }
}

void Structures::place(TrackedStructure structure) {
  const uint64_t begin = structure.address;
  end_in(begin, structure.size_bytes, begin);
  gone_.erase(begin);
  structure.version = next_version_++;
  if (addresses_.contains(begin, structure.header.size())) {
    std::memcpy(structure.header.data(), addresses_.host(begin), structure.header.size());
    if (headers_.size() > kMostGone) headers_.clear();
    headers_[structure.header] = begin;
  }
  structures_[begin] = std::move(structure);
}

void Structures::built(const runtime::BuildCommand& command, uint64_t size_bytes,
                       std::vector<GeometryContents> contents,
                       const std::vector<rtapi::RaytracingInstanceDesc>& instances) {
  TrackedStructure structure;
  structure.contents = std::move(contents);
  structure.address = command.dest;
  structure.size_bytes = size_bytes;
  if (HasAny(command.flags, BuildFlags::kPerformUpdate)) {
    // An update uses as much memory as its source.
    if (const uint64_t bytes = structure_bytes(command.source)) structure.size_bytes = bytes;
  }
  structure.top = command.type == Type::kTopLevel;
  structure.flags = command.flags & ~BuildFlags::kPerformUpdate;
  for (uint32_t i = 0; i < command.geometries.size(); ++i) {
    structure.geometries.push_back(runtime::shape_of(command.geometries[i], i));
  }
  link(command, structure);
  structure.instances.reserve(instances.size());
  for (const rtapi::RaytracingInstanceDesc& desc : instances) {
    TrackedInstance instance;
    instance.bottom_level = desc.AccelerationStructure;
    instance.contribution = desc.InstanceContributionToHitGroupIndex;
    instance.mask = desc.InstanceMask;
    instance.flags = desc.Flags;
    StructureState state;
    const TrackedStructure* level = find(desc.AccelerationStructure, state);
    if (level != nullptr && state == StructureState::kAlive) instance.version = level->version;
    structure.instances.push_back(instance);
  }
  place(std::move(structure));
}

void Structures::link(const runtime::BuildCommand& command, TrackedStructure& structure) const {
  for (uint32_t i = 0; i < command.linkages.size(); ++i) {
    if (!command.linkages[i]) continue;
    structure.geometries[i].linked = true;
    TrackedLinkage linkage;
    linkage.array = command.linkages[i]->OpacityMicromapArray;
    StructureState state;
    const TrackedStructure* array = find(linkage.array, state);
    if (array != nullptr && state == StructureState::kAlive) linkage.version = array->version;
    structure.linkages.push_back(linkage);
  }
  // Without the flag an update keeps the linkages of its source.
  if (!HasAny(command.flags, BuildFlags::kPerformUpdate) ||
      HasAny(command.flags, BuildFlags::kAllowOmmLinkageUpdate)) {
    return;
  }
  const auto source = structures_.find(command.source);
  if (source != structures_.end()) structure.linkages = source->second.linkages;
}

void Structures::copied(const runtime::CopyAccelerationStructureCommand& command,
                        uint64_t size_bytes) {
  using Mode = rtapi::RaytracingAccelerationStructureCopyMode;
  if (command.mode != Mode::kClone && command.mode != Mode::kCompact &&
      command.mode != Mode::kDeserialize) {
    return;
  }
  TrackedStructure structure;
  const auto it = structures_.find(command.source);
  if (command.mode != Mode::kDeserialize && it != structures_.end()) {
    structure = it->second;
  } else {
    structure.known = false;
  }
  structure.address = command.dest;
  if (size_bytes != 0) structure.size_bytes = size_bytes;
  place(std::move(structure));
}

uint64_t Structures::version_at(uint64_t address) const {
  StructureState state;
  const TrackedStructure* structure = address == 0 ? nullptr : find(address, state);
  return structure != nullptr && state == StructureState::kAlive ? structure->version : 0;
}

// What a move makes of its source; of other operations, what their result says.
TrackedStructure Structures::moved(const runtime::RtasResult& result) const {
  TrackedStructure structure;
  structure.address = result.address;
  structure.size_bytes = result.size_bytes;
  structure.of_clusters = result.bottom_level;
  structure.top = structure.partitioned = result.top_level;
  structure.flags = result.flags;
  const auto source = structures_.find(result.source);
  if (result.top_level || source == structures_.end()) return structure;
  structure.clusters = source->second.clusters;
  structure.linkages = source->second.linkages;
  return structure;
}

// A bottom level has the micromaps that its clusters were linked to.
void Structures::add_clusters(const runtime::RtasResult& result,
                              TrackedStructure& structure) const {
  for (const uint64_t cluster : result.clusters) {
    const auto it = structures_.find(cluster);
    if (it == structures_.end()) continue;
    structure.clusters.push_back({cluster, it->second.version});
    for (const TrackedLinkage& linkage : it->second.linkages) {
      const bool is_new = std::none_of(structure.linkages.begin(), structure.linkages.end(),
                                       [&](const auto& each) { return each == linkage; });
      if (is_new) structure.linkages.push_back(linkage);
    }
  }
  if (result.source != 0) return;
  for (const uint64_t array : result.micromaps) {
    structure.linkages.push_back({array, version_at(array)});
  }
}

// Instances that the operation neither wrote nor updated are those of its source.
void Structures::add_instances(const runtime::RtasResult& result,
                               TrackedStructure& structure) const {
  const auto source = structures_.find(result.source);
  std::vector<uint8_t> is_written(result.instances.size(), 0);
  for (const uint32_t i : result.written) is_written[i] = 1;
  for (uint32_t i = 0; i < result.instances.size(); ++i) {
    const runtime::RtasInstance& instance = result.instances[i];
    TrackedInstance tracked = {instance.bottom_level, 0, instance.contribution, instance.mask,
                               instance.flags};
    const TrackedInstance* before = nullptr;
    if (is_written[i] == 0 && source != structures_.end() && i < source->second.instances.size()) {
      before = &source->second.instances[i];
    }
    tracked.version = before != nullptr && before->bottom_level == instance.bottom_level
                          ? before->version
                          : version_at(instance.bottom_level);
    structure.instances.push_back(tracked);
  }
}

void Structures::operated(const std::vector<runtime::RtasResult>& results) {
  // Moves read all sources before they write.
  std::vector<TrackedStructure> made;
  for (const runtime::RtasResult& result : results) made.push_back(moved(result));
  for (size_t i = 0; i < results.size(); ++i) {
    add_clusters(results[i], made[i]);
    add_instances(results[i], made[i]);
    place(std::move(made[i]));
  }
}

uint64_t Structures::copied_from(uint64_t address) const {
  std::array<uint8_t, 16> bytes;
  if (!addresses_.contains(address, bytes.size())) return 0;
  std::memcpy(bytes.data(), addresses_.host(address), bytes.size());
  const auto it = headers_.find(bytes);
  return it == headers_.end() || it->second == address ? 0 : it->second;
}

uint64_t Structures::structure_bytes(uint64_t address) const {
  const auto it = structures_.find(address);
  return it == structures_.end() ? 0 : it->second.size_bytes;
}

const TrackedStructure* Structures::find(uint64_t address, StructureState& state) const {
  const auto allocation = addresses_.find(address);
  if (const auto it = structures_.find(address); it != structures_.end()) {
    const TrackedStructure& structure = it->second;
    if (!allocation) {
      state = StructureState::kFreed;
    } else if (!structure.known) {
      state = StructureState::kAlive;  // a backend may complete it at any time
    } else {
      const bool same = addresses_.contains(address, structure.header.size()) &&
                        std::memcmp(addresses_.host(address), structure.header.data(),
                                    structure.header.size()) == 0;
      state = same ? StructureState::kAlive : StructureState::kOverwritten;
    }
    return &structure;
  }
  if (copied_from(address) != 0) {
    state = StructureState::kBytesCopied;
    return nullptr;
  }
  if (const auto it = gone_.find(address); it != gone_.end()) {
    state = !allocation          ? StructureState::kFreed
            : it->second.by == 0 ? StructureState::kOverwritten
                                 : StructureState::kReplaced;
    return &it->second.structure;
  }
  state = StructureState::kNever;
  return nullptr;
}

std::string Structures::history(uint64_t address, StructureState state) const {
  switch (state) {
    case StructureState::kAlive:
      return "is there";
    case StructureState::kNever:
      return "was never built there";
    case StructureState::kOverwritten:
      return "was there, but its bytes have been overwritten";
    case StructureState::kReplaced: {
      const auto it = gone_.find(address);
      return "was there, but another one has been built or copied over it" +
             (it == gone_.end() ? std::string()
                                : ", at " + address_name(addresses_, it->second.by));
    }
    case StructureState::kFreed:
      return "was there, but its buffer has been freed";
    case StructureState::kBytesCopied:
      return "was copied there as bytes from the one at " +
             address_name(addresses_, copied_from(address)) +
             ", which does not make a structure; use CopyRaytracingAccelerationStructure";
  }
  return "";
}

}  // namespace kaamos::checks
