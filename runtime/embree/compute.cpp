// SPDX-License-Identifier: MIT
//
// Thread groups. A kernel that has no barriers, or was split at them, is one call per group. Other
// kernels run each thread of a group on a fiber: a barrier returns to the group's loop, which
// resumes the next thread, so that no thread passes before all have arrived. At wave operations it
// is the same for the threads of a wave, and those whose paths are least go on [waves.h]; kernels
// that run eight threads at once need fibers only if waves are longer.
#include <boost/context/fiber.hpp>
#include <boost/context/protected_fixedsize_stack.hpp>

#include <algorithm>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "kaamos/shader/wave_op.h"
#include "runtime/embree/compute.h"
#include "runtime/embree/dispatch.h"
#include "runtime/embree/fault.h"
#include "runtime/embree/parallel.h"
#include "runtime/embree/waves.h"
#include "runtime/shader/float_mode.h"

namespace kaamos::embree {
namespace {

namespace context = boost::context;

constexpr size_t kFiberStackBytes = 128 * 1024;

// Keeps the stacks of finished fibers for the next group of this thread.
class StackPool {
 public:
  ~StackPool() {
    for (context::stack_context& stack : free_) allocator_.deallocate(stack);
  }
  context::stack_context allocate() {
    if (free_.empty()) return allocator_.allocate();
    const context::stack_context stack = free_.back();
    free_.pop_back();
    return stack;
  }
  void deallocate(context::stack_context& stack) { free_.push_back(stack); }

 private:
  context::protected_fixedsize_stack allocator_{kFiberStackBytes};
  std::vector<context::stack_context> free_;
};

struct PooledStack {
  StackPool* pool;
  context::stack_context allocate() { return pool->allocate(); }
  void deallocate(context::stack_context& stack) { pool->deallocate(stack); }
};

struct GroupRun;

enum class Waits : uint8_t { kForNobody, kForWave, kForGroup };

// One thread of a group, or kLanes of them that run at once.
struct FiberThread {
  GroupRun* run = nullptr;
  uint32_t first = 0;  // its index in the group
  Waits waits = Waits::kForNobody;
  const shader::WaveCall* wave = nullptr;  // kForWave
  uint32_t thread_id[3] = {0, 0, 0};
  shader::Invocation invocation;
  context::fiber fiber;      // suspended at its start or where it waits; empty when finished
  context::fiber scheduler;  // where it returns to when it waits
  sigjmp_buf* jump = nullptr;
};

struct GroupRun {
  Worker* worker = nullptr;
  const ComputePipeline* pipeline = nullptr;
  shader::ComputeGroup group;
  shader::Invocation invocation;
  FiberThread* current = nullptr;
  bool failed = false;
};

void run_group(void* argument) {
  auto& run = *static_cast<GroupRun*>(argument);
  run.pipeline->compute().group(run.invocation, run.group);
}

// Waves of no more lanes than run at once.
void run_lanes(void* argument) {
  auto& run = *static_cast<GroupRun*>(argument);
  const shader::ComputeDesc& compute = run.pipeline->compute();
  const uint32_t* size = compute.thread_group;
  const uint32_t count = size[0] * size[1] * size[2];
  for (uint32_t first = 0; first < count; first += shader::kLanes) {
    compute.lanes(run.invocation, run.group, first);
  }
}

void run_thread(void* argument) {
  auto& thread = *static_cast<FiberThread*>(argument);
  if (const auto lanes = thread.run->pipeline->compute().lanes; lanes != nullptr) {
    return lanes(thread.invocation, thread.run->group, thread.first);
  }
  thread.run->pipeline->compute().thread(thread.invocation, thread.run->group, thread.thread_id);
}

context::fiber start_thread(FiberThread& thread, StackPool& pool) {
  return context::fiber(
      std::allocator_arg, PooledStack{&pool}, [&thread](context::fiber&& scheduler) {
        thread.scheduler = std::move(scheduler);
        Worker& worker = *thread.run->worker;
        if (!run_guarded_on_fiber(worker, run_thread, &thread) && !thread.run->failed) {
          thread.run->failed = true;
          record_removal(worker);
        }
        return std::move(thread.scheduler);
      });
}

void resume(GroupRun& run, FiberThread& thread, sigjmp_buf* outer) {
  thread.waits = Waits::kForNobody;
  run.current = &thread;
  thread.fiber = std::move(thread.fiber).resume();
  run.worker->jump = outer;
}

// Lets the threads of one wave run until each has ended or waits for the group.
void run_wave_threads(GroupRun& run, std::span<FiberThread> threads, sigjmp_buf* outer) {
  for (;;) {
    std::vector<WaveArrival> arrivals;
    for (FiberThread& thread : threads) {
      if (thread.fiber && (thread.waits == Waits::kForNobody || run.failed)) {
        resume(run, thread, outer);
      }
      if (!thread.fiber || thread.waits != Waits::kForWave) continue;
      arrivals.push_back({thread.wave, thread.first % run.group.wave_lanes});
    }
    if (arrivals.empty()) return;
    if (run.failed) continue;
    const std::vector<WaveArrival> next = least_path(arrivals);
    run_wave(next);
    for (FiberThread& thread : threads) {
      const auto goes_on = [&](const WaveArrival& arrival) { return arrival.call == thread.wave; };
      if (thread.waits == Waits::kForWave && std::any_of(next.begin(), next.end(), goes_on)) {
        thread.waits = Waits::kForNobody;
      }
    }
  }
}

// Runs under the group's guard: a fault here would be ours, not the shader's.
void run_fibers(void* argument) {
  auto& run = *static_cast<GroupRun*>(argument);
  thread_local StackPool pool;
  const shader::ComputeDesc& compute = run.pipeline->compute();
  const uint32_t* size = compute.thread_group;
  const uint32_t width = compute.lanes != nullptr ? uint32_t{shader::kLanes} : 1;
  const size_t count = (size_t{size[0]} * size[1] * size[2] + width - 1) / width;
  std::vector<FiberThread> threads(count);
  sigjmp_buf* const outer = run.worker->jump;
  for (size_t i = 0; i < count; ++i) {
    FiberThread& thread = threads[i];
    thread.run = &run;
    thread.first = static_cast<uint32_t>(i) * width;
    thread.thread_id[0] = static_cast<uint32_t>(i % size[0]);
    thread.thread_id[1] = static_cast<uint32_t>(i / size[0] % size[1]);
    thread.thread_id[2] = static_cast<uint32_t>(i / size[0] / size[1]);
    thread.invocation = run.invocation;
    thread.fiber = start_thread(thread, pool);
  }
  const size_t in_wave = compute.has_waves ? std::max(run.group.wave_lanes / width, 1u) : count;
  for (bool alive = true; alive;) {
    alive = false;
    for (size_t i = 0; i < count; i += in_wave) {
      run_wave_threads(run, std::span(threads).subspan(i, std::min(in_wave, count - i)), outer);
    }
    for (FiberThread& thread : threads) {
      thread.waits = Waits::kForNobody;
      if (thread.fiber) alive = true;
    }
  }
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
  const auto body = compute.group != nullptr ? run_group : at_once ? run_lanes : run_fibers;
  for (uint64_t i = begin; i < end && !job.dispatch->removed.load(std::memory_order_relaxed); ++i) {
    GroupRun run;
    run.worker = &worker;
    run.pipeline = job.pipeline;
    run.group.group_id[0] = static_cast<uint32_t>(i % job.groups[0]);
    run.group.group_id[1] = static_cast<uint32_t>(i / job.groups[0] % job.groups[1]);
    run.group.group_id[2] = static_cast<uint32_t>(i / job.groups[0] / job.groups[1]);
    std::memset(shared.get(), 0, shared_words * sizeof(Word));
    run.group.shared = shared.get();
    run.group.wave_lanes = job.wave_lanes;
    run.group.backend = &run;
    run.invocation.dispatch = &job.dispatch->abi;
    run.invocation.slots = job.pipeline->shader().slots;
    run.invocation.backend = &worker;
    for (int axis = 0; axis < 3; ++axis) {
      run.invocation.index[axis] = run.group.group_id[axis];
    }
    worker.index = run.invocation.index;
    if (!run_guarded(worker, body, &run)) {
      record_removal(worker);
    }
  }
  end_worker(worker);
}

// Called on a fiber.
void wait(GroupRun& run, Waits what_for) {
  FiberThread& thread = *run.current;
  thread.waits = what_for;
  sigjmp_buf* const own = run.worker->jump;
  thread.scheduler = std::move(thread.scheduler).resume();
  run.worker->jump = own;
  // Another thread of the group has failed: this one ends too, on its own stack.
  if (run.failed) remove_device(*run.worker, run.worker->fault_reason);
}

}  // namespace

void group_barrier(shader::ComputeGroup& group) {
  auto& run = *static_cast<GroupRun*>(group.backend);
  wait(run, Waits::kForGroup);
}

void wave_operation(shader::ComputeGroup& group, const shader::WaveCall& call) {
  auto& run = *static_cast<GroupRun*>(group.backend);
  if (answer_at_once(call, run.current->first, group.wave_lanes)) return;
  run.current->wave = &call;
  wait(run, Waits::kForWave);
}

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
