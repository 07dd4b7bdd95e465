// SPDX-License-Identifier: MIT
//
// claims/...: what the talk says about costs. northlight --claims measures the other claims.
#include "effect_run.h"

namespace kaamos::bench {
namespace {

constexpr uint32_t kRays = 16;

// "Linear in rays: 5 ms with one, 80 ms with 16." [GDC 2018 talk] The time of 16 rays against the
// line through the times of one ray and of four.
Line ao_linear(Fixtures& fixtures, const Measure& measure) {
  EffectRun run("ao", fixtures);
  const auto time_of = [&](uint32_t rays) {
    return seconds(measure, [&] { run.trace(false, rays); });
  };
  time_of(1);
  const Pairs times = run_pairs(
      measure, [&] { return time_of(kRays); },
      [&] {
        const double one = time_of(1), four = time_of(4);
        return one + (four - one) / 3 * (kRays - 1);
      });
  return {"claims/ao-linear", times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
}

// The same against 16 times one ray. The ratio is below 1, because what a pixel needs before its
// first ray is paid once.
Line ao_proportional(Fixtures& fixtures, const Measure& measure) {
  EffectRun run("ao", fixtures);
  const Pairs times = time_pairs(
      measure, [&] { run.trace(false, kRays); },
      [&] {
        for (uint32_t i = 0; i < kRays; ++i) run.trace(false);
      });
  return {"claims/ao-proportional", times.ratio, 1e3 * times.ours,
          1e3 * times.baseline,     "ms",        false};
}

}  // namespace

std::vector<Case> claims_cases() {
  return {{"claims/ao-linear", ao_linear}, {"claims/ao-proportional", ao_proportional}};
}

}  // namespace kaamos::bench
