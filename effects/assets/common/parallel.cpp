// SPDX-License-Identifier: MIT
#include "effects/assets/common/parallel.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace kaamos::effects {

std::uint32_t thread_count(std::uint32_t threads) {
  return std::max(threads > 0 ? threads : std::thread::hardware_concurrency(), 1u);
}

// A picture takes milliseconds to encode, and a thread some ten microseconds to start.
void run_parallel(std::uint32_t threads, std::size_t count,
                  const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < std::min<std::size_t>(thread_count(threads), count); ++i) {
    others.emplace_back(take);
  }
  take();
  for (std::thread& other : others) other.join();
}

}  // namespace kaamos::effects
