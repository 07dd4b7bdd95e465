// SPDX-License-Identifier: MIT
//
// The state of a running dispatch: what all its threads share (RunningDispatch), and what one
// thread uses while it runs one tile or thread group (Worker). A shader's Invocation reaches it
// through its backend pointer.
#pragma once

#include <atomic>
#include <csetjmp>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_set>
#include <vector>

#include "kaamos/shader/bound.h"
#include "runtime/backend/backend.h"
#include "runtime/embree/far_rays.h"
#include "runtime/embree/shader_record.h"

namespace kaamos::runtime {
struct Context;
}
namespace rtapi {
struct DispatchRaysDesc;
}

namespace kaamos::embree {

class TopLevel;
class Memory;

// Counts of what a dispatch did. Summed over tiles; these are integers, so the order does not
// matter.
struct Counters {
  uint64_t rays = 0;             // TraceRay calls
  uint64_t visibility_rays = 0;  // those of them that only asked whether there is a hit
  uint64_t misses = 0;           // all other rays hit something
  uint64_t any_hit_calls = 0;
  uint64_t closest_hit_calls = 0;
  uint64_t intersection_calls = 0;
  uint64_t miss_calls = 0;
  uint64_t callable_calls = 0;

  void add(const Counters& other) {
    rays += other.rays;
    visibility_rays += other.visibility_rays;
    misses += other.misses;
    any_hit_calls += other.any_hit_calls;
    closest_hit_calls += other.closest_hit_calls;
    intersection_calls += other.intersection_calls;
    miss_calls += other.miss_calls;
    callable_calls += other.callable_calls;
  }
};

// Why a device was removed: the first fault of a dispatch.
struct Removal {
  shader::RemovalReason reason = shader::RemovalReason::kOther;
  std::string text;
};

// A texture as large as the dispatch: each invocation mostly reads or writes the texel with its own
// index.
struct Picture {
  const uint8_t* texels = nullptr;
  uint32_t row_pitch = 0;
  uint32_t texel_bytes = 0;
};

struct RunningDispatch {
  shader::DispatchConstants abi;
  RecordTable hit_table;
  RecordTable miss_table;
  RecordTable callable_table;
  RecordProblems hit_problems;
  RecordProblems miss_problems;
  RecordProblems callable_problems;
  RecordProblems ray_generation_problems;
  uint32_t max_recursion_depth = 0;   // MaxTraceRecursionDepth
  uint32_t pipeline_flags = 0;        // ray flags of every TraceRay [runtime::ray_flags_of]
  uint64_t stack_bytes = UINT64_MAX;  // of the pipeline [DXR: SetPipelineStackSize]
  const Memory* memory = nullptr;
  // The resources that the shaders of a ray tracing pipeline have bound, by Shader::number.
  std::vector<shader::BoundResource> bound_resources;
  std::vector<const shader::BoundResource*> bound;
  std::vector<Picture> pictures;
  // Checked mode; null if it is off.
  const runtime::Context* context = nullptr;
  const rtapi::DispatchRaysDesc* tables = nullptr;  // null: Dispatch
  std::vector<shader::AddressRange> ranges;
  const char* label = "";  // "DispatchRays 3 of the command list": for messages

  // Set after everything else, and read first by each thread. Together with the mutex that
  // end_worker and end_dispatch take, it gives all the memory ordering that a dispatch needs,
  // whatever the scheduler promises.
  std::atomic<bool> begun = false;
  std::atomic<bool> removed = false;
  const std::atomic<bool>* stopped = &runtime::kNeverStopped;  // Context::stopped
  std::atomic<uint64_t> unknown_structure = 0;                 // one that a ray was traced against
  std::mutex mutex;                                            // guards the members below
  Removal removal;
  Counters counters;
  FarRays far_rays;
  std::vector<runtime::ReachedFrom> reached;  // each different one once, by hash
  std::unordered_set<uint64_t> reached_hashes;

  // Whether nothing more of it may begin.
  bool ends() const {
    return removed.load(std::memory_order_relaxed) || stopped->load(std::memory_order_relaxed);
  }
};

// The members that each ray reads are in the first cache line: spread over two, primary rays take
// 5 % longer.
struct alignas(64) Worker {
  RunningDispatch* dispatch = nullptr;
  const shader::BoundResource* const* bound = nullptr;  // the dispatch's
  // The acceleration structure of the last ray. Address 0 is the null structure.
  uint64_t cached_address = 0;
  std::shared_ptr<const TopLevel> cached_top_level;
  uint64_t stack_left = UINT64_MAX;  // bytes of the pipeline's stack [DXR: Pipeline stack]
  uintptr_t stack_limit = 0;         // no shader is called with less stack than this
  const Shader* running = nullptr;   // the shader that is executing: for messages
  const uint32_t* index = nullptr;   // its DispatchRaysIndex or thread group; null: a draw
  sigjmp_buf* jump = nullptr;        // where a fault ends the tile
  // Set by the signal handler or by remove_device before the jump.
  shader::RemovalReason fault_reason = shader::RemovalReason::kOther;
  int fault_signal = 0;
  uintptr_t fault_address = 0;
  // For a row that runs at once: the index of the ray that was traced, or of the first of 8.
  uint32_t fault_index[3] = {0, 0, 0};
  Counters counters;
  FarRays far_rays;
  uint64_t reached_hashes[64] = {};  // the most recent ones, by the low bits of the hash
  // The top level of rays that are traced together, since their shaders may trace against another
  // one meanwhile.
  std::shared_ptr<const TopLevel> shared_top_level;
};

inline Worker& worker_of(const shader::Invocation& invocation) {
  return *static_cast<Worker*>(invocation.backend);
}

}  // namespace kaamos::embree
