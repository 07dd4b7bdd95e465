// SPDX-License-Identifier: MIT
//
// DispatchRays and Dispatch on the device's threads.
#pragma once

#include <tbb/task_arena.h>

#include <memory>
#include <string>
#include <vector>

#include <rtapi/result.h>

#include "kaamos/shader/wave_op.h"
#include "runtime/backend/executor.h"
#include "runtime/embree/state_object.h"
#include "runtime/embree/worker.h"

namespace kaamos::embree {

// The parts of a device that a dispatch needs.
struct DispatchEnvironment {
  tbb::task_arena* arena = nullptr;
  const Memory* memory = nullptr;
  const runtime::Context* context = nullptr;
  uint32_t wave_lanes = shader::kDefaultWaveLanes;
};

// The outcome. An error removes the device: KA0890 to KA0893, KA0897.
struct CountedOutcome : runtime::DispatchOutcome {
  Counters counters;
};

// Runs every cell of the grid once, in 2-D tiles. `label` names the dispatch in messages.
CountedOutcome dispatch_rays(const DispatchEnvironment& environment,
                             const runtime::DispatchRaysCommand& command, const std::string& label);

// Runs every thread group once. [compute.cpp]
CountedOutcome dispatch_compute(const DispatchEnvironment& environment,
                                const runtime::DispatchCommand& command, const std::string& label);

// Used by both: fills in what shaders see of the list's state.
void begin_dispatch(const DispatchEnvironment& environment, const runtime::RootBindings& state,
                    RunningDispatch& dispatch);
CountedOutcome end_dispatch(RunningDispatch& dispatch);
// Begin and end one thread's share of a dispatch: set up its worker, and add the worker's counters
// to the dispatch's.
void begin_worker(RunningDispatch& dispatch, Worker& worker);
void end_worker(Worker& worker);

}  // namespace kaamos::embree
