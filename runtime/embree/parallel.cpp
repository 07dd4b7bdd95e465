// SPDX-License-Identifier: MIT
//
// oneTBB is not instrumented, so the thread sanitizer sees neither its locks nor the order that
// they establish. This file is not instrumented either, so that one half of oneTBB (its headers) is
// not checked against the other half. It tells the sanitizer which order holds: the fork before
// every task, every task before the join, and no order between tasks.
#include "runtime/embree/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#if defined(KAAMOS_THREAD_SANITIZER)
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace kaamos::embree {
namespace {

class TaskOrder {
 public:
#if defined(KAAMOS_THREAD_SANITIZER)
  void fork() {
    __tsan_release(&fork_);
  }
  void begin_task() {
    __tsan_acquire(&fork_);
  }
  void end_task() {
    __tsan_release(&join_);
  }
  void join() {
    __tsan_acquire(&join_);
  }

 private:
  char fork_ = 0;
  char join_ = 0;
#else
  void fork() {}
  void begin_task() {}
  void end_task() {}
  void join() {}
#endif
};

#if defined(KAAMOS_THREAD_SANITIZER)
// Shared by all builds of the process, because a callback does not say which one it belongs to.
TaskOrder builder_order;
#endif

}  // namespace

#if defined(KAAMOS_THREAD_SANITIZER)
BuilderRun::BuilderRun() {
  builder_order.fork();
}
BuilderRun::~BuilderRun() {
  builder_order.join();
}
BuilderCallback::BuilderCallback() {
  builder_order.begin_task();
}
BuilderCallback::~BuilderCallback() {
  builder_order.end_task();
}
#endif

void parallel_ranges(tbb::task_arena& arena, uint64_t count, RangeBody body, const void* context) {
  TaskOrder order;
  order.fork();
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<uint64_t>(0, count),
                      [&](const tbb::blocked_range<uint64_t>& range) {
                        order.begin_task();
                        body(context, range.begin(), range.end());
                        order.end_task();
                      });
  });
  order.join();
}

void run_in_arena(tbb::task_arena& arena, void (*body)(const void* context), const void* context) {
  TaskOrder order;
  order.fork();
  arena.execute([&] {
    order.begin_task();
    body(context);
    order.end_task();
  });
  order.join();
}

}  // namespace kaamos::embree
