// SPDX-License-Identifier: MIT
#include "tests/conformance/rules.h"

#include <algorithm>
#include <array>

namespace kaamos::conformance {

namespace {

constexpr Rule kRules[] = {
#define RULE(section, number, tag, title, ...) {#section "-" #number, #tag[0], title, __VA_ARGS__},
#include "tests/conformance/rules.inc"
#define LATER(section, number, tag, title, reason) \
  {#section "-" #number, #tag[0], title, nullptr, nullptr, reason},
#include "tests/conformance/cls_rules.inc"
#include "tests/conformance/omm_rules.inc"
#include "tests/conformance/ptl_rules.inc"
#include "tests/conformance/ras_rules.inc"
#include "tests/conformance/ser_rules.inc"
#include "tests/conformance/top_rules.inc"
#undef LATER
#undef RULE
};

static_assert(std::count_if(std::begin(kRules), std::end(kRules),
                            [](const Rule& rule) { return rule.tag == 'R'; }) == 598);

}  // namespace

std::span<const Rule> all_rules() {
  return kRules;
}

const Rule* find_rule(std::string_view id) {
  const auto* rule = std::find_if(std::begin(kRules), std::end(kRules),
                                  [&](const Rule& each) { return each.id == id; });
  return rule == std::end(kRules) ? nullptr : rule;
}

}  // namespace kaamos::conformance
