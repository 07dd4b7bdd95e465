// SPDX-License-Identifier: MIT
// Loops over all processors. [Win32: the Parallel Patterns Library, ppl.h]
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <initializer_list>
#include <iterator>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace concurrency {
namespace details {

// Calls f(0) to f(count - 1), each once, on as many threads as there are processors, of which the
// caller is one. The first exception ends the loop and is thrown to the caller when all threads
// have ended.
template <typename Function>
void run(std::size_t count, const Function& f) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr thrown;
  std::mutex mutex;
  const auto work = [&] {
    try {
      for (std::size_t i; (i = next.fetch_add(1)) < count;) f(i);
    } catch (...) {
      next = count;
      const std::lock_guard<std::mutex> lock(mutex);
      if (!thrown) thrown = std::current_exception();
    }
  };
  const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::thread> others(count == 0 ? 0 : std::min(processors, count) - 1);
  for (std::thread& thread : others) thread = std::thread(work);
  work();
  for (std::thread& thread : others) thread.join();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace details

/// Calls f(i) for `first`, `first + step`, ... below `last`, in no order, and returns when all have
/// ended; throws what the first of them threw. `step` is above 0.
template <typename Index, typename Function>
void parallel_for(Index first, Index last, Index step, const Function& f) {
  if (!(first < last)) return;
  const std::size_t distance = static_cast<std::size_t>(last - first);
  const std::size_t stride = static_cast<std::size_t>(step);
  details::run((distance + stride - 1) / stride, [&](std::size_t i) {
    f(static_cast<Index>(first + static_cast<Index>(i * stride)));
  });
}
template <typename Index, typename Function>
void parallel_for(Index first, Index last, const Function& f) {
  parallel_for(first, last, static_cast<Index>(1), f);
}

/// Calls f with each element of a random-access range, in no order.
template <typename Iterator, typename Function>
void parallel_for_each(Iterator first, Iterator last, const Function& f) {
  using Difference = typename std::iterator_traits<Iterator>::difference_type;
  details::run(static_cast<std::size_t>(last - first),
               [&](std::size_t i) { f(first[static_cast<Difference>(i)]); });
}

/// Calls each function once, in no order.
template <typename... Functions>
void parallel_invoke(const Functions&... functions) {
  details::run(sizeof...(functions), [&](std::size_t i) {
    std::size_t at = 0;
    (void)std::initializer_list<int>{(at++ == i ? (void)functions() : (void)0, 0)...};
  });
}

}  // namespace concurrency

namespace Concurrency = concurrency;
