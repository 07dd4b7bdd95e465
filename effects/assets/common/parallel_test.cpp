// SPDX-License-Identifier: MIT
#include "effects/assets/common/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace kaamos::effects {
namespace {

TEST(Parallel, EachPieceIsDoneOnce) {
  for (const std::uint32_t threads : {0u, 1u, 2u, 7u}) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{100}}) {
      std::vector<std::atomic<int>> done(count);
      run_parallel(threads, count, [&](std::size_t i) { ++done[i]; });
      for (const auto& each : done) EXPECT_EQ(each, 1);
    }
  }
}

TEST(Parallel, OneThreadIsTheCallers) {
  run_parallel(1, 3, [caller = std::this_thread::get_id()](std::size_t) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
  });
}

// Every piece waits until all threads have one, so fewer would wait forever.
TEST(Parallel, AllThreadsWorkAtOnce) {
  constexpr std::uint32_t kThreads = 3;
  std::atomic<std::uint32_t> running{0};
  std::mutex mutex;
  std::set<std::thread::id> ids;
  run_parallel(kThreads, kThreads, [&](std::size_t) {
    ++running;
    while (running < kThreads) std::this_thread::yield();
    const std::lock_guard lock(mutex);
    ids.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(ids.size(), kThreads);
}

TEST(Parallel, ZeroThreadsAreThoseOfTheProcessor) {
  EXPECT_EQ(thread_count(5), 5u);
  EXPECT_GE(thread_count(0), 1u);
}

}  // namespace
}  // namespace kaamos::effects
