// SPDX-License-Identifier: MIT
#include "runtime/embree/acceleration_structure.h"

#include <algorithm>
#include <utility>

#include "runtime/embree/device.h"
#include "runtime/embree/parallel.h"
#include "runtime/operations/operations.h"
#include "runtime/structures/instances.h"
#include "runtime/structures/structure_commands.h"
#include "runtime/structures/structure_copies.h"

namespace kaamos::embree {
namespace {

using runtime::AccelerationStructure;

rtapi::Status build_top_level(Device& device, const runtime::BuildCommand& command,
                              AccelerationStructure& structure) {
  auto instances = runtime::read_instances(device.structure_environment(), command);
  if (!instances) return instances.error();
  auto level = TopLevel::build(device.build_context(), *instances);
  if (!level) return level.error();
  structure.top_level = *level;
  structure.instances = runtime::records_of(*instances);
  return {};
}

rtapi::Status build_bottom_level(Device& device, const runtime::BuildCommand& command,
                                 const AccelerationStructure* source,
                                 AccelerationStructure& structure) {
  if (source == nullptr) {
    auto level = BottomLevel::build(device.build_context(), command.geometries, command.flags,
                                    structure.linkages);
    if (!level) return level.error();
    structure.bottom_level = *level;
    runtime::warn_out_of_range(device.structure_environment(), command.dest,
                               (*level)->out_of_range_triangles());
    return {};
  }
  const auto level = std::static_pointer_cast<BottomLevel>(source->bottom_level);
  std::vector<bool> linked;
  for (const auto& linkage : command.linkages) linked.push_back(linkage.has_value());
  if (auto s = level->check_update(command.geometries, command.flags, linked); !s) return s;
  const bool in_place = command.source == command.dest;
  if (in_place && !device.memory().is_shared(level.get())) {
    structure.bottom_level = level;
    return level->update(device.build_context(), command.geometries, structure.linkages);
  }
  auto updated =
      level->updated_copy(device.build_context(), command.geometries, structure.linkages);
  if (!updated) return updated.error();
  structure.bottom_level = *updated;
  return {};
}

// Runs `build` on the device's threads and records the memory that Embree took as the structure's
// size.
template <typename Build>
rtapi::Status measured(Device& device, AccelerationStructure& result, Build&& build) {
  const int64_t before = device.embree_bytes();
  rtapi::Status status;
  run_in_arena(device.arena(), [&] { status = build(); });
  result.compacted_bytes =
      static_cast<uint64_t>(std::max<int64_t>(device.embree_bytes() - before, 0));
  return status;
}

// The level of the last operation is changed in place: no other structure has it, and no ray runs.
rtapi::Status build_partitioned_level(Device& device,
                                      const runtime::PartitionedInstances& instances,
                                      AccelerationStructure& result) {
  if (result.top_level != nullptr) {
    const auto level = std::const_pointer_cast<TopLevel>(
        std::static_pointer_cast<const TopLevel>(result.top_level));
    auto updated = level->update(instances);
    if (!updated) return updated.error();
    if (*updated) return {};
  }
  auto level = TopLevel::build_partitioned(device.build_context(), instances);
  if (!level) return level.error();
  result.top_level = *level;
  return {};
}

runtime::RebuildLevel rebuild_level(Device& device) {
  runtime::RebuildLevel rebuild;
  rebuild.bottom_level = [&device](std::span<const rtapi::RaytracingGeometryDesc> geometries,
                                   std::span<const runtime::GeometryShape> shapes,
                                   AccelerationStructure& result) {
    return measured(device, result, [&]() -> rtapi::Status {
      auto level = BottomLevel::build(device.build_context(), geometries, result.flags,
                                      result.linkages, shapes);
      if (!level) return level.error();
      result.bottom_level = *level;
      return {};
    });
  };
  rebuild.top_level = [&device](const std::vector<runtime::Instance>& instances,
                                AccelerationStructure& result) {
    return measured(device, result, [&]() -> rtapi::Status {
      auto level = TopLevel::build(device.build_context(), instances);
      if (!level) return level.error();
      result.top_level = *level;
      return {};
    });
  };
  rebuild.partitioned_level = [&device](const runtime::PartitionedInstances& instances,
                                        AccelerationStructure& result) {
    rtapi::Status status;
    run_in_arena(device.arena(),
                 [&] { status = build_partitioned_level(device, instances, result); });
    return status;
  };
  rebuild.clustered_level = [&device](std::vector<runtime::ClusteredGeometry> geometries,
                                      AccelerationStructure& result) {
    return measured(device, result, [&]() -> rtapi::Status {
      auto level =
          BottomLevel::build_clustered(device.build_context(), std::move(geometries), result.flags);
      if (!level) return level.error();
      result.bottom_level = *level;
      return {};
    });
  };
  return rebuild;
}

}  // namespace

rtapi::Status copy(Device& device, const runtime::CopyAccelerationStructureCommand& command) {
  return runtime::copy_structure(device.structure_environment(), command, rebuild_level(device));
}

rtapi::Status complete_structures(Device& device) {
  return runtime::complete_structures(device.structure_environment(), rebuild_level(device));
}

rtapi::Status execute_operations(Device& device, const runtime::RtasOperationsCommand& command,
                                 const std::string& label) {
  return runtime::execute_operations(device.structure_environment(), command, label,
                                     rebuild_level(device));
}

rtapi::Status build(Device& device, const runtime::BuildCommand& command) {
  const auto build_level = [&](const AccelerationStructure* source, AccelerationStructure& result) {
    return measured(device, result, [&] {
      return command.type == rtapi::RaytracingAccelerationStructureType::kTopLevel
                 ? build_top_level(device, command, result)
                 : build_bottom_level(device, command, source, result);
    });
  };
  return runtime::build_structure(device.structure_environment(), command, build_level);
}

}  // namespace kaamos::embree
