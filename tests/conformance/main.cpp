// SPDX-License-Identifier: MIT
//
// kaamos-conformance: tests a machine and its drivers against DXR's rules.
#include <rtapi/version.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "runtime/files/write_file.h"
#include "tests/conformance/report.h"

namespace {

using namespace kaamos::conformance;

bool g_summary_only = false;

// Shows a status line at a terminal while tests run; prints nothing elsewhere.
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
    if (!is_chosen(rule, filter)) continue;
    const bool tested = std::any_of(tests.begin(), tests.end(), [&](const RuleTest& test) {
      return test_covers(test, rule.id);
    });
    std::cout << rule.id << " [" << rule.tag << "] " << rule.title
              << (tested                ? ""
                  : rule.tag == 'F'     ? " (free: tests assert nothing)"
                  : rule.not_applicable ? " (not applicable)"
                  : rule.not_offered    ? " (not offered)"
                                        : " (not yet tested)")
              << "\n";
  }
}

// The tiers that devices can have.
std::vector<std::string> tier_names() {
  using rtapi::RaytracingTier;
  std::vector<std::string> out;
  for (const RaytracingTier tier :
       {RaytracingTier::kNotSupported, RaytracingTier::kTier1_0, RaytracingTier::kTier1_1,
        RaytracingTier::kTier1_2, RaytracingTier::kTier2_0}) {
    if (tier <= rtapi::kHighestRaytracingTier) out.emplace_back(rtapi::GetName(tier));
  }
  return out;
}

// Without --precision, the two Embree precisions that keep the most rules.
std::vector<Target> targets_of(const std::string& backend, const std::string& precision,
                               bool checked, rtapi::RaytracingTier tier) {
  using rtapi::TraversalPrecision;
  const std::pair<const char*, TraversalPrecision> precisions[] = {
      {"exact", TraversalPrecision::kExact},
      {"robust", TraversalPrecision::kRobust},
      {"fast", TraversalPrecision::kFast}};
  std::vector<Target> out;
  for (const auto& [name, value] : precisions) {
    const bool wanted = precision.empty() ? value != TraversalPrecision::kFast : precision == name;
    if (wanted && backend != "vulkan") out.push_back({"embree", value, checked, tier});
  }
  if (backend != "embree") out.push_back({"vulkan", TraversalPrecision::kRobust, checked, tier});
  return out;
}

// Returns what is wrong with the request; empty if nothing is.
std::string misuse(const std::string& backend, const std::string& precision,
                   const std::string& filter) {
  if (backend == "vulkan" && !precision.empty()) {
    return "--precision applies to embree only, because Vulkan drivers have triangle tests of "
           "their own: leave out one of --backend vulkan and --precision";
  }
  const auto unknown = first_unknown(filter);
  if (!unknown) return {};
  return "no rule's number begins with \"" + *unknown +
         "\"; --list prints all of them, such as SBT-01";
}

}  // namespace

int main(int argc, char** argv) {
  std::string backend, filter, json, precision;
  std::string tier_name = rtapi::GetName(rtapi::kHighestRaytracingTier);
  bool list = false, checked = false;
  CLI::App app("Tests this machine's backends against the rules of DirectX Raytracing.");
  app.set_version_flag("--version", std::string("kaamos-conformance ") + rtapi::GetVersion());
  app.add_option("--backend", backend, "embree or vulkan; default: every backend there is")
      ->check(CLI::IsMember({"embree", "vulkan"}));
  app.add_option("--precision", precision,
                 "precision of embree: fast, robust or exact; default: exact and robust")
      ->check(CLI::IsMember({"fast", "robust", "exact"}));
  app.add_option("--tier", tier_name,
                 "tier of the devices; what it refuses of a higher one does not fail")
      ->check(CLI::IsMember(tier_names()))
      ->capture_default_str();
  app.add_option("--filter", filter,
                 "only rules whose number begins with this, such as SBT-; several: SBT-,TRV-2");
  app.add_option("--json", json, "write the results into this file");
  app.add_flag("--checked", checked,
               "run in checked mode; a message about a test without a violation fails the rule");
  app.add_flag("--list", list, "print the rules and run nothing");
  app.add_flag("--summary", g_summary_only, "print only failures and the summary");
  CLI11_PARSE(app, argc, argv);
  for (char& c : filter) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  if (const std::string error = misuse(backend, precision, filter); !error.empty()) {
    std::cerr << "kaamos-conformance: " << error << "\n";
    return 2;
  }
  const rtapi::RaytracingTier tier = rtapi::ParseRaytracingTier(tier_name).value();
  if (list) {
    list_rules(filter);
    return 0;
  }
  std::vector<TargetResults> results;
  bool failed = false;
  for (const Target& target : targets_of(backend, precision, checked, tier)) {
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
  const int error = json.empty() ? 0 : kaamos::files::write_file(json, json_of(results) + "\n");
  if (error != 0) {
    std::cerr << "cannot write " << json << ": " << std::strerror(error) << "\n";
    return 2;
  }
  return failed || results.empty() ? 1 : 0;
}
