// SPDX-License-Identifier: MIT
//
// Shader threads that wait for each other, each on a fiber of its own: at a barrier a thread
// returns to the group's loop, which resumes the next one, so that none passes before all have
// arrived. At wave operations it is the same for the threads of a wave, and those whose paths are
// least go on [waves.h].
#pragma once

#include <boost/context/fiber.hpp>

#include <csetjmp>
#include <cstdint>
#include <span>

#include "kaamos/shader/abi.h"
#include "kaamos/shader/wave_op.h"
#include "runtime/embree/worker.h"

namespace kaamos::embree {

struct FiberGroup;

// One thread of a group, or several lanes of it that run at once.
struct FiberThread {
  enum class Waits : uint8_t { kForNobody, kForWave, kForGroup };

  FiberGroup* run = nullptr;
  uint32_t first = 0;  // the index of its first lane in the group
  Waits waits = Waits::kForNobody;
  const shader::WaveCall* wave = nullptr;  // kForWave
  shader::Invocation invocation;
  boost::context::fiber fiber;      // suspended at its start or where it waits; empty when finished
  boost::context::fiber scheduler;  // where it returns to when it waits
};

// `group.backend` is its own address while it runs.
struct FiberGroup {
  Worker* worker = nullptr;
  shader::ComputeGroup group;
  shader::Invocation invocation;  // each thread gets a copy
  void (*body)(FiberThread& thread) = nullptr;
  const void* context = nullptr;  // the body's
  FiberThread* current = nullptr;
  bool failed = false;
  bool split_quad = false;  // out: not all lanes of a wave came to a derivative together
};

// Runs body for lanes 0, width, 2 * width, ... below `lane_count`, in waves of `group.wave_lanes`;
// 0 waves: all threads are one. Call it under run_guarded: a fault in a thread ends the whole group
// and is recorded; one here would be ours, not the shader's.
void run_fibers(FiberGroup& group, uint32_t lane_count, uint32_t width, uint32_t threads_in_wave);

}  // namespace kaamos::embree
