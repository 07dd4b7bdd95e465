// SPDX-License-Identifier: MIT
//
// claims/...: what the seeds say of costs. The others: northlight --claims.
#include "effect_run.h"

namespace kaamos::bench {
namespace {

// "Linear in rays: 5 ms with one, 80 ms with 16." [GDC 2018 talk]
Line ao_linear(Fixtures& fixtures, const Measure& measure) {
  constexpr uint32_t kRays = 16;
  EffectRun run(kAoEffect, fixtures);
  const Pairs times = time_pairs(
      measure, [&] { run.trace(false, kRays); },
      [&] {
        for (uint32_t i = 0; i < kRays; ++i) run.trace(false);
      });
  return {"claims/ao-linear", times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
}

}  // namespace

std::vector<Case> claims_cases() {
  return {{"claims/ao-linear", ao_linear}};
}

}  // namespace kaamos::bench
