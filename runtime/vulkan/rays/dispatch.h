// SPDX-License-Identifier: MIT
//
// DispatchRays and Dispatch. Tables and blocks are written when the command executes, and the work
// is done when the call returns.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kaamos/shader/spirv_interface.h"
#include "runtime/backend/backend.h"
#include "runtime/backend/executor.h"
#include "runtime/vulkan/memory/command_stream.h"
#include "runtime/vulkan/memory/memory.h"
#include "runtime/vulkan/rays/dispatch_split.h"
#include "runtime/vulkan/structures/acceleration_structure.h"

namespace kaamos::runtime {
struct Context;
}

namespace kaamos::vulkan {

// Memory that successive dispatches reuse for their tables and blocks.
class DispatchMemory {
 public:
  // At least `size_bytes` bytes, with undefined contents; the address is a multiple of 64 KiB.
  rtapi::Result<const GpuBuffer*> get(Gpu& gpu, uint64_t size_bytes);

 private:
  std::unique_ptr<GpuBuffer> buffer_;
};

// The parts of a device that a dispatch needs.
struct DispatchEnvironment {
  CommandStream* stream = nullptr;
  const Memory* memory = nullptr;
  AccelerationStructures* structures = nullptr;
  DispatchMemory* scratch = nullptr;
  // Grids that exceed these or the device's limits run in parts.
  GridLimits limits = {};
  DispatchMemory* checks = nullptr;
  const runtime::Context* context = nullptr;
};

// The outcome. An error removes the device: KA0890, KA0891, KA0893 asked for by a shader, KA0892 a
// table in no buffer, KA0955 device lost, KA0956 over a limit, KA0990 out of memory.
struct CountedOutcome : runtime::DispatchOutcome {
  // If the device collects them. A miss without a miss shader counts as a hit, because only shaders
  // can count.
  rtapi::RaytracingStatistics statistics;
};

// `label` names the dispatch in messages.
CountedOutcome dispatch_rays(const DispatchEnvironment& environment,
                             const runtime::DispatchRaysCommand& command, const std::string& label);

// [compute.cpp]
CountedOutcome dispatch_compute(const DispatchEnvironment& environment,
                                const runtime::DispatchCommand& command, const std::string& label);

// Used by both: what shaders see of the list's state and of the scene.
shader::spirv::DispatchBlock dispatch_block(const runtime::RootBindings& state,
                                            const SceneTables& scene);
// Writes the status and a block for each part to the start of `buffer`. `checks`: as in
// DispatchFeedback.
void write_blocks(const shader::spirv::DispatchBlock& block, const std::vector<GridPart>& parts,
                  const GpuBuffer& buffer, uint64_t checks);
uint64_t bytes_of_blocks(size_t part_count);
uint64_t address_of_block(const GpuBuffer& buffer, size_t part);
// A status, and a block behind it.
inline constexpr uint64_t kStatusBytes = 128;
inline constexpr uint64_t kBlockBytes = 704;  // blocks are at multiples of 64
static_assert(sizeof(shader::spirv::DispatchFeedback) <= kStatusBytes);
static_assert(sizeof(shader::spirv::DispatchBlock) <= kBlockBytes);
// Submits what was recorded and waits; wild addresses in shaders are errors.
rtapi::Status flush_guarded(CommandStream& stream, const std::string& label);
// Returns an error that says why a shader removed the device, if one did. `status`: what shaders
// wrote.
rtapi::Status status_of(const uint8_t* status, uint32_t declared_depth, uint32_t depth_limit,
                        const std::string& label);
// Both.
rtapi::Status run_dispatch(CommandStream& stream, const GpuBuffer& buffer, uint32_t declared_depth,
                           uint32_t depth_limit, const std::string& label);
// After the work is done: adds what shaders counted.
void add_counts(const uint8_t* status, rtapi::RaytracingStatistics& statistics);

}  // namespace kaamos::vulkan
