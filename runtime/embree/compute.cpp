// SPDX-License-Identifier: MIT
//
// Thread groups. A kernel that has no barriers, or was split at them, is one call per group. Other
// kernels run each thread of a group on a fiber [fiber_group.h]; those that run eight threads at
// once need fibers only if waves are longer.
#include <algorithm>
#include <cstring>
#include <memory>

#include "kaamos/shader/wave_op.h"
#include "runtime/embree/dispatch.h"
#include "runtime/embree/fault.h"
#include "runtime/embree/fiber_group.h"
#include "runtime/embree/parallel.h"
#include "runtime/shader/float_mode.h"

namespace kaamos::embree {
namespace {

struct GroupRun {
  const ComputePipeline* pipeline = nullptr;
  FiberGroup fibers;
};

void run_group(void* argument) {
  auto& run = *static_cast<GroupRun*>(argument);
  run.pipeline->compute().group(run.fibers.invocation, run.fibers.group);
}

// Waves of no more lanes than run at once.
void run_lanes(void* argument) {
  auto& run = *static_cast<GroupRun*>(argument);
  const shader::ComputeDesc& compute = run.pipeline->compute();
  const uint32_t* size = compute.thread_group;
  const uint32_t count = size[0] * size[1] * size[2];
  for (uint32_t first = 0; first < count; first += shader::kLanes) {
    compute.lanes(run.fibers.invocation, run.fibers.group, first);
  }
}

void run_thread(FiberThread& thread) {
  const auto& pipeline = *static_cast<const ComputePipeline*>(thread.run->context);
  const shader::ComputeDesc& compute = pipeline.compute();
  if (compute.lanes != nullptr) {
    return compute.lanes(thread.invocation, thread.run->group, thread.first);
  }
  const uint32_t* size = compute.thread_group;
  const uint32_t id[3] = {thread.first % size[0], thread.first / size[0] % size[1],
                          thread.first / size[0] / size[1]};
  compute.thread(thread.invocation, thread.run->group, id);
}

void run_threads(void* argument) {
  auto& run = *static_cast<GroupRun*>(argument);
  const shader::ComputeDesc& compute = run.pipeline->compute();
  const uint32_t width = compute.lanes != nullptr ? uint32_t{shader::kLanes} : 1;
  run_fibers(run.fibers, run.fibers.group.threads, width,
             compute.has_waves ? std::max(run.fibers.group.wave_lanes / width, 1u) : 0);
}

struct ComputeJob {
  RunningDispatch* dispatch;
  const ComputePipeline* pipeline;
  const uint32_t* groups;
  uint32_t wave_lanes;
};

void run_groups(const ComputeJob& job, uint64_t begin, uint64_t end) {
  const shader::FloatMode float_mode;
  const shader::ComputeDesc& compute = job.pipeline->compute();
  // 16 extra bytes, so that a kernel without groupshared memory still gets a pointer.
  const size_t shared_words = compute.shared_bytes / 16 + 1;
  struct alignas(16) Word {
    uint8_t bytes[16];
  };
  const auto shared = std::make_unique<Word[]>(shared_words);
  Worker worker;
  begin_worker(*job.dispatch, worker);
  worker.running = &job.pipeline->shader();
  const bool at_once = compute.lanes != nullptr && job.wave_lanes <= shader::kLanes;
  const auto body = compute.group != nullptr ? run_group : at_once ? run_lanes : run_threads;
  for (uint64_t i = begin; i < end && !job.dispatch->ends(); ++i) {
    GroupRun group_run = {job.pipeline, {}};
    FiberGroup& run = group_run.fibers;
    run.worker = &worker;
    run.body = run_thread;
    run.context = job.pipeline;
    run.group.group_id[0] = static_cast<uint32_t>(i % job.groups[0]);
    run.group.group_id[1] = static_cast<uint32_t>(i / job.groups[0] % job.groups[1]);
    run.group.group_id[2] = static_cast<uint32_t>(i / job.groups[0] / job.groups[1]);
    std::memset(shared.get(), 0, shared_words * sizeof(Word));
    run.group.shared = shared.get();
    run.group.wave_lanes = job.wave_lanes;
    run.group.threads = compute.thread_group[0] * compute.thread_group[1] * compute.thread_group[2];
    run.group.backend = &run;
    run.invocation.dispatch = &job.dispatch->abi;
    run.invocation.slots = job.pipeline->shader().slots;
    run.invocation.backend = &worker;
    for (int axis = 0; axis < 3; ++axis) {
      run.invocation.index[axis] = run.group.group_id[axis];
    }
    worker.index = run.invocation.index;
    if (!run_guarded(worker, body, &group_run)) {
      record_removal(worker);
    }
  }
  end_worker(worker);
}

}  // namespace

CountedOutcome dispatch_compute(const DispatchEnvironment& environment,
                                const runtime::DispatchCommand& command, const std::string& label) {
  const auto& pipeline = static_cast<const ComputePipeline&>(*command.pipeline);
  RunningDispatch dispatch;
  begin_dispatch(environment, command.state, dispatch);
  std::memcpy(dispatch.abi.dimensions, command.groups, sizeof(command.groups));
  dispatch.label = label.c_str();
  const uint64_t count = uint64_t{command.groups[0]} * command.groups[1] * command.groups[2];
  const ComputeJob job = {&dispatch, &pipeline, command.groups, environment.wave_lanes};
  dispatch.begun.store(true, std::memory_order_release);
  if (count != 0) {
    parallel_ranges(*environment.arena, count,
                    [&](uint64_t begin, uint64_t end) { run_groups(job, begin, end); });
  }
  return end_dispatch(dispatch);
}

}  // namespace kaamos::embree
