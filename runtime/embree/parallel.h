// SPDX-License-Identifier: MIT
//
// Runs ranges of work on the device's threads.
#pragma once

#include <tbb/task_arena.h>

#include <cstdint>

namespace kaamos::embree {

using RangeBody = void (*)(const void* context, uint64_t begin, uint64_t end);

// Calls body(context, begin, end) on the arena's threads, for ranges that together cover [0,
// count). Every call sees what was written before, and the caller then sees what the calls wrote.
void parallel_ranges(tbb::task_arena& arena, uint64_t count, RangeBody body, const void* context);

template <typename Body>
void parallel_ranges(tbb::task_arena& arena, uint64_t count, const Body& body) {
  parallel_ranges(
      arena, count,
      [](const void* context, uint64_t begin, uint64_t end) {
        (*static_cast<const Body*>(context))(begin, end);
      },
      &body);
}

// A BuilderRun is on the stack while Embree builds, and a BuilderCallback in each callback that
// Embree makes meanwhile, from any thread. The callbacks see what was written before the build, and
// what they write is seen after it. Embree itself ensures that order, but the thread sanitizer
// cannot see it.
class BuilderRun {
 public:
  BuilderRun();
  ~BuilderRun();
  BuilderRun(const BuilderRun&) = delete;
  BuilderRun& operator=(const BuilderRun&) = delete;
};
class BuilderCallback {
 public:
  BuilderCallback();
  ~BuilderCallback();
  BuilderCallback(const BuilderCallback&) = delete;
  BuilderCallback& operator=(const BuilderCallback&) = delete;
};
#if !defined(KAAMOS_THREAD_SANITIZER)
inline BuilderRun::BuilderRun() {}
inline BuilderRun::~BuilderRun() {}
inline BuilderCallback::BuilderCallback() {}
inline BuilderCallback::~BuilderCallback() {}
#endif

// Calls body(context) inside the arena, so that its threads help with whatever work body starts.
void run_in_arena(tbb::task_arena& arena, void (*body)(const void* context), const void* context);

template <typename Body>
void run_in_arena(tbb::task_arena& arena, const Body& body) {
  run_in_arena(
      arena, [](const void* context) { (*static_cast<const Body*>(context))(); }, &body);
}

}  // namespace kaamos::embree
