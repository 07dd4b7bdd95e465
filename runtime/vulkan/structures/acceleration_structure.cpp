// SPDX-License-Identifier: MIT
#include "runtime/vulkan/structures/acceleration_structure.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "runtime/operations/operations.h"
#include "runtime/structures/build_inputs.h"
#include "runtime/structures/instances.h"
#include "runtime/structures/structure_commands.h"
#include "runtime/structures/structure_copies.h"
#include "runtime/vulkan/structures/instance_table.h"
#include "runtime/vulkan/structures/top_level.h"

namespace kaamos::vulkan {
namespace {

using runtime::AccelerationStructure;
using runtime::BuildFlags;
using shader::spirv::TopLevelEntry;

const TopLevel& top_level_of(const AccelerationStructure& structure) {
  return static_cast<const TopLevel&>(*structure.top_level);
}

// Used by one thread at a time, except for evict(), which any thread may call.
class Structures final : public AccelerationStructures {
 public:
  Structures(std::shared_ptr<Gpu> gpu, const runtime::Context& context)
      : gpu_(std::move(gpu)), context_(context), micromaps_(gpu_) {}
  // Buffers may outlive the device, but the structures in them may not.
  ~Structures() override { map_->evict(0, UINT64_MAX); }
  rtapi::Status start(Memory& memory);

  rtapi::RaytracingAccelerationStructurePrebuildInfo prebuild_info(
      const runtime::BuildCommand& inputs) const override {
    return runtime::estimate_sizes(inputs);
  }
  rtapi::Status build(CommandStream& stream, const runtime::BuildCommand& command) override;
  rtapi::Status copy(CommandStream& stream,
                     const runtime::CopyAccelerationStructureCommand& command) override;
  rtapi::Status emit(CommandStream& stream,
                     const runtime::EmitPostbuildInfoCommand& command) override;
  rtapi::Status execute(CommandStream& stream, const runtime::RtasOperationsCommand& command,
                        const std::string& label) override;
  void evict(uint64_t address, uint64_t size_bytes) override { map_->evict(address, size_bytes); }
  std::shared_ptr<const AccelerationStructure> find(uint64_t address) const override {
    return map_->find(address);
  }
  rtapi::Result<SceneTables> tables() override;

 private:
  runtime::StructureEnvironment environment() {
    return {context_, *map_, "Vulkan", has_micromaps(*gpu_)};
  }
  rtapi::Status build_top_level(const runtime::BuildCommand& command,
                                AccelerationStructure& result);
  rtapi::Status build_bottom_level(const runtime::BuildCommand& command,
                                   const AccelerationStructure* source,
                                   AccelerationStructure& result);
  runtime::RebuildLevel rebuild_level();
  rtapi::Status write_table();

  std::shared_ptr<Gpu> gpu_;
  runtime::Context context_;
  std::shared_ptr<runtime::StructureMap> map_ = std::make_shared<runtime::StructureMap>();
  std::shared_ptr<InstanceTable> instances_;
  MicromapBuffers micromaps_;
  std::shared_ptr<TopLevel> empty_;
  // Those in the table. They stay alive at least until tables() is called again, because shaders
  // may still trace against them.
  std::vector<std::shared_ptr<const AccelerationStructure>> listed_;
  std::unique_ptr<GpuBuffer> table_;
  uint32_t table_mask_ = 0;
  uint64_t max_hit_record_ = 15;
};

rtapi::Status Structures::start(Memory& memory) {
  auto table = InstanceTable::create(gpu_);
  if (!table) return table.error();
  instances_ = std::move(*table);
  auto empty = TopLevel::build(gpu_, *instances_, {}, BuildFlags::kNone);
  if (!empty) return empty.error();
  empty_ = std::move(*empty);
  memory.on_buffer_end(
      [map = map_](uint64_t address, uint64_t size_bytes) { map->evict(address, size_bytes); });
  return write_table();
}

rtapi::Status Structures::build(CommandStream& stream, const runtime::BuildCommand& command) {
  if (auto s = stream.flush(); !s) return s;
  const auto build_level = [&](const AccelerationStructure* source, AccelerationStructure& result) {
    return command.type == rtapi::RaytracingAccelerationStructureType::kTopLevel
               ? build_top_level(command, result)
               : build_bottom_level(command, source, result);
  };
  return runtime::build_structure(environment(), command, build_level);
}

rtapi::Status Structures::build_top_level(const runtime::BuildCommand& command,
                                          AccelerationStructure& result) {
  auto instances = runtime::read_instances(environment(), command);
  if (!instances) return instances.error();
  auto level = TopLevel::build(gpu_, *instances_, *instances, command.flags);
  if (!level) return level.error();
  result.compacted_bytes = (*level)->held_bytes();
  result.top_level = std::move(*level);
  result.instances = runtime::records_of(*instances);
  return {};
}

// An update is a build with the source's indices: lavapipe rebuilds in any case, and the order of
// primitives depends on what has moved.
rtapi::Status Structures::build_bottom_level(const runtime::BuildCommand& command,
                                             const AccelerationStructure* source,
                                             AccelerationStructure& result) {
  const BottomLevel* update_of = nullptr;
  if (source != nullptr) {
    update_of = &static_cast<const BottomLevel&>(*source->bottom_level);
    std::vector<bool> linked;
    for (const auto& linkage : command.linkages) linked.push_back(linkage.has_value());
    if (auto s = runtime::check_update(update_of->shapes(), update_of->flags(), command.geometries,
                                       command.flags, linked);
        !s) {
      return s;
    }
  }
  std::vector<rtapi::RaytracingGeometryDesc> geometries;
  geometries.reserve(command.geometries.size());
  for (const auto& geometry : command.geometries) {
    geometries.push_back(runtime::as_host_sees(geometry, *context_.addresses));
  }
  auto level = BottomLevel::build(gpu_, geometries, command.flags, result.linkages, update_of);
  if (!level) return level.error();
  runtime::warn_out_of_range(environment(), command.dest, (*level)->out_of_range_triangles());
  result.compacted_bytes = (*level)->held_bytes();
  result.bottom_level = std::move(*level);
  return {};
}

rtapi::Status Structures::copy(CommandStream& stream,
                               const runtime::CopyAccelerationStructureCommand& command) {
  if (auto s = stream.flush(); !s) return s;
  return runtime::copy_structure(environment(), command, rebuild_level());
}

runtime::RebuildLevel Structures::rebuild_level() {
  runtime::RebuildLevel rebuild;
  rebuild.bottom_level = [this](std::span<const rtapi::RaytracingGeometryDesc> geometries,
                                std::span<const runtime::GeometryShape> shapes,
                                AccelerationStructure& result) -> rtapi::Status {
    auto level =
        BottomLevel::build(gpu_, geometries, result.flags, result.linkages, nullptr, shapes);
    if (!level) return level.error();
    result.compacted_bytes = (*level)->held_bytes();
    result.bottom_level = std::move(*level);
    return {};
  };
  rebuild.top_level = [this](const std::vector<runtime::Instance>& instances,
                             AccelerationStructure& result) -> rtapi::Status {
    auto level = TopLevel::build(gpu_, *instances_, instances, result.flags);
    if (!level) return level.error();
    result.compacted_bytes = (*level)->held_bytes();
    result.top_level = std::move(*level);
    return {};
  };
  rebuild.clustered_level = [this](std::vector<runtime::ClusteredGeometry> geometries,
                                   AccelerationStructure& result) -> rtapi::Status {
    auto level = BottomLevel::build_clustered(gpu_, std::move(geometries), result.flags);
    if (!level) return level.error();
    result.compacted_bytes = (*level)->held_bytes();
    result.bottom_level = std::move(*level);
    return {};
  };
  return rebuild;
}

rtapi::Status Structures::emit(CommandStream& stream,
                               const runtime::EmitPostbuildInfoCommand& command) {
  if (auto s = stream.flush(); !s) return s;
  return runtime::emit_postbuild_info(environment(), command.desc, command.sources);
}

rtapi::Status Structures::execute(CommandStream& stream,
                                  const runtime::RtasOperationsCommand& command,
                                  const std::string& label) {
  if (auto s = stream.flush(); !s) return s;
  return runtime::execute_operations(environment(), command, label, rebuild_level());
}

rtapi::Result<SceneTables> Structures::tables() {
  if (auto s = runtime::complete_structures(environment(), rebuild_level()); !s) return s.error();
  auto top_levels = map_->top_levels();
  if (top_levels != listed_) {
    listed_ = std::move(top_levels);
    if (auto s = write_table(); !s) return s.error();
    micromaps_.release_unused();
  }
  for (const auto& structure : listed_) {
    if (auto s = top_level_of(*structure).link_micromaps(micromaps_); !s) return s.error();
  }
  SceneTables result;
  result.instances = instances_->address();
  result.position_tables = instances_->position_tables();
  result.top_levels = table_->address();
  result.top_level_mask = table_mask_;
  result.empty_top_level = empty_->address();
  result.max_hit_record = max_hit_record_;
  return result;
}

// At least half of the slots stay empty, so that a search ends soon.
rtapi::Status Structures::write_table() {
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
  max_hit_record_ = 15;
  auto* entries = reinterpret_cast<TopLevelEntry*>(table_->host());
  for (const auto& structure : listed_) {
    const TopLevel& level = top_level_of(*structure);
    uint32_t slot = shader::spirv::top_level_hash(structure->address) & table_mask_;
    while (entries[slot].address != 0) slot = (slot + 1) & table_mask_;
    entries[slot] = level.entry(structure->address);
    max_hit_record_ = std::max(max_hit_record_, level.largest_hit_record());
  }
  return {};
}

}  // namespace

bool has_micromaps(const Gpu& gpu) {
  return gpu.is_lavapipe();
}

rtapi::Result<std::unique_ptr<AccelerationStructures>> AccelerationStructures::create(
    std::shared_ptr<Gpu> gpu, std::shared_ptr<Memory> memory, const runtime::Context& context) {
  auto result = std::make_unique<Structures>(std::move(gpu), context);
  if (auto s = result->start(*memory); !s) return s.error();
  return std::unique_ptr<AccelerationStructures>(std::move(result));
}

}  // namespace kaamos::vulkan
