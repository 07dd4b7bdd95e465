// SPDX-License-Identifier: MIT
//
// The acceleration structures of a device: which are where, how they are built, and the tables in
// which shaders find them (spirv_interface.h: TopLevelEntry, InstanceEntry).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/backend/backend.h"
#include "runtime/vulkan/memory/command_stream.h"
#include "runtime/vulkan/memory/memory.h"

namespace kaamos::vulkan {

// The part of a DispatchBlock that describes the live structures. Everything it refers to stays
// valid until the next call that changes structures.
struct SceneTables {
  uint64_t instances = 0;
  uint64_t position_tables = 0;
  uint64_t top_levels = 0;
  uint32_t top_level_mask = 0;
  uint64_t empty_top_level = 0;
  // The largest index of a hit group record that a ray can reach through a live top level: the
  // maximum of InstanceContributionToHitGroupIndex + 15 + 15 * (geometries - 1) over all instances,
  // or 15 if there are none.
  uint64_t max_hit_record = 15;
};

// Shaders decide the opacity of what has micromaps, and need a driver that gives them all bits of a
// ray's flags.
bool has_micromaps(const Gpu& gpu);

class AccelerationStructures {
 public:
  static rtapi::Result<std::unique_ptr<AccelerationStructures>> create(
      std::shared_ptr<Gpu> gpu, std::shared_ptr<Memory> memory, const runtime::Context& context);
  virtual ~AccelerationStructures() = default;

  virtual rtapi::RaytracingAccelerationStructurePrebuildInfo prebuild_info(
      const runtime::BuildCommand& inputs) const = 0;

  // Commands. Each flushes the stream before it reads GPU memory. Errors remove the device; ids and
  // texts are the same as in the Embree backend.
  virtual rtapi::Status build(CommandStream& stream, const runtime::BuildCommand& command) = 0;
  virtual rtapi::Status copy(CommandStream& stream,
                             const runtime::CopyAccelerationStructureCommand& command) = 0;
  virtual rtapi::Status emit(CommandStream& stream,
                             const runtime::EmitPostbuildInfoCommand& command) = 0;
  virtual rtapi::Status execute(CommandStream& stream,
                                const runtime::RtasOperationsCommand& command,
                                const std::string& label) = 0;
  // Ends the structures with bytes in a range that is written or freed.
  virtual void evict(uint64_t address, uint64_t size_bytes) = 0;

  virtual std::shared_ptr<const runtime::AccelerationStructure> find(uint64_t address) const = 0;

  // The tables, up to date for the next dispatch. Call it after flushing the stream.
  virtual rtapi::Result<SceneTables> tables() = 0;
};

}  // namespace kaamos::vulkan
