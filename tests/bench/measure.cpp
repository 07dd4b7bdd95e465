// SPDX-License-Identifier: MIT
#include "measure.h"

#include <time.h>

#include <algorithm>

namespace kaamos::bench {
namespace {

double clock_seconds(clockid_t clock) {
  timespec now;
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double median(std::vector<double> values) {
  const size_t middle = values.size() / 2;
  std::sort(values.begin(), values.end());
  return values.size() % 2 != 0 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Pairs run_pairs(const Measure& measure, const std::function<double()>& ours,
                const std::function<double()>& baseline) {
  std::vector<double> of_ours;
  std::vector<double> of_baseline;
  std::vector<double> ratios;
  for (int pair = 0; pair < measure.pairs; ++pair) {
    if (measure.progress) measure.progress(pair, measure.pairs);
    const bool ours_first = pair % 2 == 0;
    double a = ours_first ? ours() : 0;
    const double b = baseline();
    if (!ours_first) a = ours();
    of_ours.push_back(a);
    of_baseline.push_back(b);
    ratios.push_back(a / b);
  }
  return {median(std::move(of_ours)), median(std::move(of_baseline)), median(std::move(ratios))};
}

double seconds(const Measure& measure, const std::function<void()>& work) {
  const bool cpu = measure.clock == Clock::kCpu;
  const clockid_t clock = cpu ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC;
  const double start = clock_seconds(clock);
  work();
  const double spent = clock_seconds(clock) - start;
  return std::max(cpu ? spent / measure.threads : spent, 1e-9);
}

Pairs time_pairs(const Measure& measure, const std::function<void()>& ours,
                 const std::function<void()>& baseline) {
  ours();
  baseline();
  return run_pairs(
      measure, [&] { return seconds(measure, ours); }, [&] { return seconds(measure, baseline); });
}

}  // namespace kaamos::bench
