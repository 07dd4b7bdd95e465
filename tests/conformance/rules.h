// SPDX-License-Identifier: MIT
//
// The rules of DXR and of drawing that Kaamos keeps, and the known deviations.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace kaamos::conformance {

struct Rule {
  const char* id;  // "SBT-02"
  // R required; O observed on native runtimes; U undefined, with a policy of ours; A the
  // application's duty; F freedom of implementations; I our reading; C computed.
  char tag;
  const char* title;
  const char* not_applicable = nullptr;  // why the rule cannot be kept or broken here
  const char* partly = nullptr;          // which part of the rule does not apply
  const char* not_offered = nullptr;     // which feature the rule is of, that Kaamos does not have

  bool required() const { return tag == 'R'; }
};

std::span<const Rule> all_rules();
const Rule* find_rule(std::string_view id);

// A filter is beginnings of numbers, "SBT-0,TRV-22"; an empty one chooses every rule.
bool is_chosen(const Rule& rule, std::string_view filter);
// The first of the filter's beginnings that no rule has; none if each has one.
std::optional<std::string> first_unknown(std::string_view filter);

// A rule that a target is known to break, and the reason.
struct Deviation {
  const char* rule;
  const char* target;  // Target::name()
  const char* driver;  // part of the device's name; "" means every device
  const char* reason;
};
const Deviation* find_deviation(std::string_view rule, std::string_view target,
                                std::string_view device_name);

}  // namespace kaamos::conformance
