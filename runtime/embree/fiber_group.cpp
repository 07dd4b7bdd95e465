// SPDX-License-Identifier: MIT
#include "runtime/embree/fiber_group.h"

#include <boost/context/protected_fixedsize_stack.hpp>

#include <algorithm>
#include <vector>

#include "runtime/embree/compute.h"
#include "runtime/embree/fault.h"
#include "runtime/embree/waves.h"

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

using Waits = FiberThread::Waits;

void run_thread(void* argument) {
  auto& thread = *static_cast<FiberThread*>(argument);
  thread.run->body(thread);
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

void resume(FiberGroup& run, FiberThread& thread, sigjmp_buf* outer) {
  thread.waits = Waits::kForNobody;
  run.current = &thread;
  thread.fiber = std::move(thread.fiber).resume();
  run.worker->jump = outer;
}

// Lets the threads of one wave run until each has ended or waits for the group.
void run_wave_threads(FiberGroup& run, std::span<FiberThread> threads, sigjmp_buf* outer) {
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
    if (shader::is_derivative(next[0].call->op) && next.size() != threads.size()) {
      run.split_quad = true;
    }
    run_wave(next);
    for (FiberThread& thread : threads) {
      const auto goes_on = [&](const WaveArrival& arrival) { return arrival.call == thread.wave; };
      if (thread.waits == Waits::kForWave && std::any_of(next.begin(), next.end(), goes_on)) {
        thread.waits = Waits::kForNobody;
      }
    }
  }
}

// Called on a fiber.
void wait(FiberGroup& run, Waits what_for) {
  FiberThread& thread = *run.current;
  thread.waits = what_for;
  sigjmp_buf* const own = run.worker->jump;
  thread.scheduler = std::move(thread.scheduler).resume();
  run.worker->jump = own;
  // Another thread of the group has failed: this one ends too, on its own stack.
  if (run.failed) remove_device(*run.worker, run.worker->fault_reason);
}

}  // namespace

void run_fibers(FiberGroup& run, uint32_t lane_count, uint32_t width, uint32_t threads_in_wave) {
  thread_local StackPool pool;
  const size_t count = (size_t{lane_count} + width - 1) / width;
  std::vector<FiberThread> threads(count);
  sigjmp_buf* const outer = run.worker->jump;
  run.group.backend = &run;
  for (size_t i = 0; i < count; ++i) {
    FiberThread& thread = threads[i];
    thread.run = &run;
    thread.first = static_cast<uint32_t>(i) * width;
    thread.invocation = run.invocation;
    thread.fiber = start_thread(thread, pool);
  }
  const size_t in_wave = threads_in_wave == 0 ? count : threads_in_wave;
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

void group_barrier(shader::ComputeGroup& group) {
  auto& run = *static_cast<FiberGroup*>(group.backend);
  wait(run, Waits::kForGroup);
}

void wave_operation(shader::ComputeGroup& group, const shader::WaveCall& call) {
  auto& run = *static_cast<FiberGroup*>(group.backend);
  if (answer_at_once(call, run.current->first, group)) return;
  run.current->wave = &call;
  wait(run, Waits::kForWave);
}

}  // namespace kaamos::embree
