// SPDX-License-Identifier: MIT
//
// Pairs of runs of Kaamos and of a baseline, taken in turn, and their medians.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace kaamos::bench {

// The cost of a run: wall-clock time, or CPU time of all threads divided by their number, which
// other work on the machine disturbs less but which hides idle threads.
enum class Clock { kWall, kCpu };

struct Measure {
  int pairs = 9;
  Clock clock = Clock::kWall;
  uint32_t threads = 1;
  std::function<void(int done, int of)> progress;  // may be empty
};

// Medians over the pairs; `ratio` is the median of the pairs' ours / baseline.
struct Pairs {
  double ours = 0;
  double baseline = 0;
  double ratio = 0;
};

// The middle value, or the mean of the two middle ones. `values` must not be empty.
double median(std::vector<double> values);

// Each function returns what it measured. Every second pair runs the baseline first.
Pairs run_pairs(const Measure& measure, const std::function<double()>& ours,
                const std::function<double()>& baseline);

// The time that `work` takes by measure.clock, in seconds.
double seconds(const Measure& measure, const std::function<void()>& work);

// Times pairs in seconds, after one uncounted run of each.
Pairs time_pairs(const Measure& measure, const std::function<void()>& ours,
                 const std::function<void()>& baseline);

}  // namespace kaamos::bench
