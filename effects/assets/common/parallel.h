// SPDX-License-Identifier: MIT
/// @file
/// Independent pieces of work on the host's threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace kaamos::effects {

/// The threads that a count asks for, at least 1. 0: all that the processor has.
std::uint32_t thread_count(std::uint32_t threads);

/// Calls work(0) to work(count - 1), each once, on that many threads [thread_count], of which the
/// caller's is one; returns when all are done. They begin in their order. `work` must not throw.
void run_parallel(std::uint32_t threads, std::size_t count,
                  const std::function<void(std::size_t index)>& work);

}  // namespace kaamos::effects
