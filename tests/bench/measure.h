// SPDX-License-Identifier: MIT
//
// Pairs of runs of Kaamos and of a baseline, in turn, and their medians.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace kaamos::bench {

// What a run costs: time on the wall, or CPU time of all threads over their count, which other
// work on the machine disturbs less but which hides idle threads.
enum class Clock { kWall, kCpu };

struct Measure {
  int pairs = 9;
  Clock clock = Clock::kWall;
  uint32_t threads = 1;
  std::function<void(int done, int of)> progress;  // may be empty
};

// Medians over the pairs; `ratio` is the median of each pair's ours / baseline.
struct Pairs {
  double ours = 0;
  double baseline = 0;
  double ratio = 0;
};

// The middle one, or the mean of the two middle ones. `values` is not empty.
double median(std::vector<double> values);

// Each function returns what it measured. Every second pair runs the baseline first.
Pairs run_pairs(const Measure& measure, const std::function<double()>& ours,
                const std::function<double()>& baseline);

// Seconds that `work` takes by measure.clock.
double seconds(const Measure& measure, const std::function<void()>& work);

// Pairs of seconds, after one run of each that does not count.
Pairs time_pairs(const Measure& measure, const std::function<void()>& ours,
                 const std::function<void()>& baseline);

}  // namespace kaamos::bench
