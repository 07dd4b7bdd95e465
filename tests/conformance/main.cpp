// SPDX-License-Identifier: MIT
//
// kaamos-conformance: holds a machine and its drivers against DXR's rules.
#include <rtapi/version.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "tests/conformance/report.h"

namespace {

using namespace kaamos::conformance;

bool g_summary_only = false;

// A line that stays while tests run, for one who waits at a terminal; elsewhere nothing.
void show(const std::string& line) {
  static const bool terminal = isatty(STDERR_FILENO) != 0;
  if (terminal && g_summary_only) std::cerr << "\r\033[K" << line << std::flush;
}

void print(const RuleResult& result) {
  const bool bad = result.outcome == Outcome::kFailed || result.outcome == Outcome::kKnownDeviation;
  if (g_summary_only && !bad) return;
  show("");
  std::cout << line_of(result) << std::endl;
}

void list_rules(const std::string& filter) {
  const auto tests = all_tests();
  for (const Rule& rule : all_rules()) {
    if (std::string_view(rule.id).substr(0, filter.size()) != filter) continue;
    const bool tested = std::any_of(tests.begin(), tests.end(), [&](const RuleTest& test) {
      return test_covers(test, rule.id);
    });
    std::cout << rule.id << " [" << rule.tag << "] " << rule.title
              << (tested                ? ""
                  : rule.tag == 'F'     ? " (free: nothing is asserted)"
                  : rule.not_applicable ? " (not applicable)"
                                        : " (not yet tested)")
              << "\n";
  }
}

// Without a precision Embree's two that keep most rules.
std::vector<Target> targets_of(const std::string& backend, const std::string& precision,
                               bool checked) {
  using rtapi::TraversalPrecision;
  const std::pair<const char*, TraversalPrecision> precisions[] = {
      {"exact", TraversalPrecision::kExact},
      {"robust", TraversalPrecision::kRobust},
      {"fast", TraversalPrecision::kFast}};
  std::vector<Target> out;
  for (const auto& [name, value] : precisions) {
    const bool wanted = precision.empty() ? value != TraversalPrecision::kFast : precision == name;
    if (wanted && backend != "vulkan") out.push_back({"embree", value, checked});
  }
  if (backend != "embree") out.push_back({"vulkan", TraversalPrecision::kRobust, checked});
  return out;
}

// What was asked for and cannot be; empty: nothing.
std::string misuse(const std::string& backend, const std::string& precision,
                   const std::string& filter) {
  if (backend == "vulkan" && !precision.empty()) {
    return "--precision is of embree, the triangle test of a Vulkan driver is its own: leave out "
           "one of --backend vulkan and --precision";
  }
  const auto& rules = all_rules();
  const bool any = std::any_of(rules.begin(), rules.end(), [&](const Rule& rule) {
    return std::string_view(rule.id).substr(0, filter.size()) == filter;
  });
  if (any) return {};
  return "no rule's number begins with \"" + filter + "\"; --list prints all, SBT-01 is one";
}

}  // namespace

int main(int argc, char** argv) {
  std::string backend, filter, json, precision;
  bool list = false, checked = false;
  CLI::App app("Holds this machine's backends against the rules of DirectX Raytracing.");
  app.set_version_flag("--version", std::string("kaamos-conformance ") + rtapi::GetVersion());
  app.add_option("--backend", backend, "embree or vulkan; without it every one there is")
      ->check(CLI::IsMember({"embree", "vulkan"}));
  app.add_option("--precision", precision,
                 "of embree: fast, robust or exact; without it exact and robust")
      ->check(CLI::IsMember({"fast", "robust", "exact"}));
  app.add_option("--filter", filter, "only rules whose number begins so, e.g. SBT-");
  app.add_option("--json", json, "writes the results into this file");
  app.add_flag("--checked", checked,
               "in checked mode; what it says of a test without a breach fails the rule");
  app.add_flag("--list", list, "prints the rules and runs nothing");
  app.add_flag("--summary", g_summary_only, "prints failures and the summary only");
  CLI11_PARSE(app, argc, argv);
  for (char& c : filter) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  if (const std::string error = misuse(backend, precision, filter); !error.empty()) {
    std::cerr << "kaamos-conformance: " << error << "\n";
    return 2;
  }
  if (list) {
    list_rules(filter);
    return 0;
  }
  std::vector<TargetResults> results;
  bool failed = false;
  for (const Target& target : targets_of(backend, precision, checked)) {
    const DeviceCheck device = check_device(target);
    if (!device.error.empty()) {
      std::cerr << target.name() << ": no device: " << device.error << "\n";
      failed = failed || !backend.empty();
      continue;
    }
    std::cout << target.name() << ": " << device.name << std::endl;
    const auto progress = [&](const Progress& now) { show(line_of(target, now)); };
    results.emplace_back(target, run_rules(target, device.name, filter, print, progress));
    show("");
  }
  for (const TargetResults& each : results) {
    for (const RuleResult& result : each.second) {
      failed = failed || result.outcome == Outcome::kFailed;
    }
    std::cout << summary_of(each) << "\n";
  }
  if (!json.empty() && !(std::ofstream(json) << json_of(results) << "\n")) {
    std::cerr << "cannot write " << json << "\n";
    return 2;
  }
  return failed || results.empty() ? 1 : 0;
}
