// SPDX-License-Identifier: MIT
//
// Work in ranges on the device's threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstdint>

#if defined(__SANITIZE_THREAD__)
#define KAAMOS_THREAD_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define KAAMOS_THREAD_SANITIZER 1
#endif
#endif

#if defined(KAAMOS_THREAD_SANITIZER)
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace kaamos::embree {

// The order that oneTBB gives its tasks, told to the thread sanitizer, which cannot see it because
// oneTBB is not instrumented: what was written before the fork is seen by every task, and what the
// tasks wrote is seen after the join; tasks among themselves are not ordered.
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

// Calls body(begin, end) for ranges that together are [0, count), on the arena's threads.
template <typename Body>
void parallel_ranges(tbb::task_arena& arena, uint64_t count, const Body& body) {
  TaskOrder order;
  order.fork();
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<uint64_t>(0, count),
                      [&](const tbb::blocked_range<uint64_t>& range) {
                        order.begin_task();
                        body(range.begin(), range.end());
                        order.end_task();
                      });
  });
  order.join();
}

}  // namespace kaamos::embree
