// SPDX-License-Identifier: MIT
//
// sorting/...: an effect over the lounge with its rays sorted by direction, against the same rays
// unsorted. .../trace times the dispatch alone, .../net includes keys and sorting. [effects-spec
// B1.5]
#include "effect_run.h"

namespace kaamos::bench {
namespace {

Case sorting_case(const std::string& effect, bool net) {
  const std::string name = "sorting/" + effect + (net ? "/net" : "/trace");
  return {name, [=](Fixtures& fixtures, const Measure& measure) -> Line {
            EffectRun run(effect, fixtures);
            const Pairs times = time_pairs(
                measure,
                [&] {
                  if (net) run.sort();
                  run.trace(true);
                },
                [&] { run.trace(false); });
            return {name, times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
          }};
}

}  // namespace

std::vector<Case> sorting_cases() {
  std::vector<Case> out;
  for (const char* effect : {"ao", "sun", "reflections"}) {
    for (const bool net : {false, true}) out.push_back(sorting_case(effect, net));
  }
  return out;
}

}  // namespace kaamos::bench
