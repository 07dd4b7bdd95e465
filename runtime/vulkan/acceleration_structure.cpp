// SPDX-License-Identifier: MIT
#include "runtime/vulkan/acceleration_structure.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "runtime/build_inputs.h"
#include "runtime/instances.h"

namespace kaamos::vulkan {
namespace {

using runtime::AccelerationStructure;
using shader::spirv::TopLevelEntry;

const TopLevel& top_level_of(const AccelerationStructure& structure) {
  return static_cast<const TopLevel&>(*structure.top_level);
}

}  // namespace

rtapi::Result<std::unique_ptr<AccelerationStructures>> AccelerationStructures::create(
    std::shared_ptr<Gpu> gpu, const runtime::Context& context) {
  std::unique_ptr<AccelerationStructures> result(
      new AccelerationStructures(std::move(gpu), context));
  auto table = InstanceTable::create(result->gpu_);
  if (!table) return table.error();
  result->instances_ = std::move(*table);
  auto empty = TopLevel::build(result->gpu_, *result->instances_, {}, runtime::BuildFlags::kNone);
  if (!empty) return empty.error();
  result->empty_ = std::move(*empty);
  if (auto s = result->write_table(); !s) return s.error();
  return result;
}

AccelerationStructures::~AccelerationStructures() {
  // Buffers may outlive the device, but not what stands in them.
  map_->evict(0, UINT64_MAX);
}

rtapi::Status AccelerationStructures::build(const runtime::BuildCommand& command) {
  const auto build_level = [&](const AccelerationStructure* source, AccelerationStructure& result) {
    return command.type == rtapi::RaytracingAccelerationStructureType::kTopLevel
               ? build_top_level(command, result)
               : build_bottom_level(command, source, result);
  };
  return runtime::build_structure(environment(), command, build_level);
}

rtapi::Status AccelerationStructures::build_top_level(const runtime::BuildCommand& command,
                                                      AccelerationStructure& result) {
  auto instances = runtime::read_instances(environment(), command);
  if (!instances) return instances.error();
  auto level = TopLevel::build(gpu_, *instances_, *instances, command.flags);
  if (!level) return level.error();
  result.compacted_bytes = (*level)->held_bytes();
  result.top_level = std::move(*level);
  return {};
}

// An update is a build with the indices of the source: lavapipe builds anew in any case, and the
// order of the primitives follows what moved.
rtapi::Status AccelerationStructures::build_bottom_level(const runtime::BuildCommand& command,
                                                         const AccelerationStructure* source,
                                                         AccelerationStructure& result) {
  const BottomLevel* update_of = nullptr;
  if (source != nullptr) {
    update_of = &static_cast<const BottomLevel&>(*source->bottom_level);
    if (auto s = runtime::check_update(update_of->shapes(), update_of->flags(), command.geometries,
                                       command.flags);
        !s) {
      return s;
    }
  }
  std::vector<rtapi::RaytracingGeometryDesc> geometries;
  geometries.reserve(command.geometries.size());
  for (const auto& geometry : command.geometries) {
    geometries.push_back(runtime::as_host_sees(geometry, *context_.addresses));
  }
  auto level = BottomLevel::build(gpu_, geometries, command.flags, update_of);
  if (!level) return level.error();
  runtime::warn_out_of_range(environment(), command.dest, (*level)->out_of_range_triangles());
  result.compacted_bytes = (*level)->held_bytes();
  result.bottom_level = std::move(*level);
  return {};
}

rtapi::Status AccelerationStructures::copy(
    const runtime::CopyAccelerationStructureCommand& command) {
  return runtime::copy_structure(environment(), command);
}

rtapi::Status AccelerationStructures::emit_postbuild_info(
    const runtime::EmitPostbuildInfoCommand& command) {
  return runtime::emit_postbuild_info(environment(), command.desc, command.sources);
}

rtapi::Result<DispatchStructures> AccelerationStructures::for_dispatch() {
  auto top_levels = map_->top_levels();
  if (top_levels != listed_) {
    listed_ = std::move(top_levels);
    if (auto s = write_table(); !s) return s.error();
  }
  DispatchStructures result;
  result.instances = instances_->address();
  result.top_levels = table_->address();
  result.top_level_mask = table_mask_;
  result.empty_top_level = empty_->address();
  result.largest_hit_record = largest_hit_record_;
  result.kept = listed_;
  return result;
}

// Half of the slots at least stay empty, so that a search ends soon.
rtapi::Status AccelerationStructures::write_table() {
  const auto slots = std::bit_ceil(static_cast<uint32_t>(2 * listed_.size() + 2));
  if (table_ == nullptr || slots > table_mask_ + 1) {
    auto table = gpu_->create_buffer(slots * sizeof(TopLevelEntry), "table of top levels");
    if (!table) {
      listed_.clear();
      return table.error();
    }
    table_ = std::move(*table);
    table_mask_ = slots - 1;
  } else {
    std::memset(table_->host(), 0, table_->size_bytes());
  }
  largest_hit_record_ = 0;
  auto* entries = reinterpret_cast<TopLevelEntry*>(table_->host());
  for (const auto& structure : listed_) {
    const TopLevel& level = top_level_of(*structure);
    uint32_t slot = shader::spirv::top_level_hash(structure->address) & table_mask_;
    while (entries[slot].address != 0) slot = (slot + 1) & table_mask_;
    entries[slot] = {structure->address, level.address()};
    largest_hit_record_ = std::max(largest_hit_record_, level.largest_hit_record());
  }
  return {};
}

}  // namespace kaamos::vulkan
