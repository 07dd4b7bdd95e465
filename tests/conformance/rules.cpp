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
                            [](const Rule& rule) { return rule.tag == 'R'; }) == 603);

// Calls `take` with each beginning of a filter until it returns false.
template <class Take>
void for_each_beginning(std::string_view filter, Take take) {
  for (bool last = false; !last;) {
    const size_t comma = filter.find(',');
    last = comma == std::string_view::npos;
    if (!take(filter.substr(0, comma))) return;
    if (!last) filter.remove_prefix(comma + 1);
  }
}

bool begins(const Rule& rule, std::string_view beginning) {
  return std::string_view(rule.id).substr(0, beginning.size()) == beginning;
}

}  // namespace

std::span<const Rule> all_rules() {
  return kRules;
}

bool is_chosen(const Rule& rule, std::string_view filter) {
  bool chosen = false;
  for_each_beginning(filter, [&](std::string_view beginning) {
    chosen = begins(rule, beginning);
    return !chosen;
  });
  return chosen;
}

std::optional<std::string> first_unknown(std::string_view filter) {
  std::optional<std::string> unknown;
  for_each_beginning(filter, [&](std::string_view beginning) {
    if (std::none_of(std::begin(kRules), std::end(kRules),
                     [&](const Rule& rule) { return begins(rule, beginning); })) {
      unknown = beginning;
    }
    return !unknown;
  });
  return unknown;
}

const Rule* find_rule(std::string_view id) {
  const auto* rule = std::find_if(std::begin(kRules), std::end(kRules),
                                  [&](const Rule& each) { return each.id == id; });
  return rule == std::end(kRules) ? nullptr : rule;
}

}  // namespace kaamos::conformance
