// SPDX-License-Identifier: MIT
//
// Rules that a backend breaks for a reason outside this project, each with its evidence. An entry
// that is no longer needed shows as a pass.
#include <span>

#include "tests/conformance/rules.h"

namespace kaamos::conformance {

namespace {

// Ends with an entry without a rule.
constexpr Deviation kDeviations[] = {
    {nullptr, nullptr, nullptr, nullptr},
};

}  // namespace

const Deviation* find_deviation(std::string_view rule, std::string_view backend,
                                std::string_view device_name) {
  for (const Deviation& each : kDeviations) {
    if (each.rule != nullptr && each.rule == rule && each.backend == backend &&
        device_name.find(each.driver) != std::string_view::npos) {
      return &each;
    }
  }
  return nullptr;
}

}  // namespace kaamos::conformance
