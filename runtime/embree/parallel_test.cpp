// SPDX-License-Identifier: MIT
#include "runtime/embree/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <thread>
#include <vector>

namespace kaamos::embree {
namespace {

TEST(Parallel, RangesCoverEachIndexOnce) {
  for (const int threads : {1, 2, 7}) {
    tbb::task_arena arena(threads);
    for (const uint64_t count : {0u, 1u, 2u, 1000u}) {
      std::vector<int> calls(count, 0);
      parallel_ranges(arena, count, [&](uint64_t begin, uint64_t end) {
        for (uint64_t i = begin; i < end; ++i) ++calls[i];
      });
      EXPECT_EQ(calls, std::vector<int>(count, 1)) << threads << " threads, " << count;
    }
  }
}

TEST(Parallel, RunInArenaReturnsAfterTheBody) {
  tbb::task_arena arena(2);
  int result = 0;
  run_in_arena(arena, [&] { result = tbb::this_task_arena::max_concurrency(); });
  EXPECT_EQ(result, 2);
}

#if defined(__SANITIZE_THREAD__)
// Our annotations of oneTBB for the sanitizer must not hide a real race between two tasks.
TEST(Parallel, TheThreadSanitizerSeesARaceBetweenTasks) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto race = [] {
    tbb::task_arena arena(2);
    int shared = 0;
    std::atomic<int> inside = 0;
    parallel_ranges(arena, 2, [&](uint64_t, uint64_t) {
      // Both tasks should be running before either writes, unless a single thread has to do all.
      ++inside;
      for (int i = 0; i < 10000 && inside.load(std::memory_order_relaxed) < 2; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      ++shared;
    });
    std::exit(shared == 0 ? 1 : 0);  // the sanitizer turns it into 66 if it reported a race
  };
  EXPECT_EXIT(race(), testing::ExitedWithCode(66), "data race");
}
#endif

}  // namespace
}  // namespace kaamos::embree
