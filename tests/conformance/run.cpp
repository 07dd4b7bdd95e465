// SPDX-License-Identifier: MIT
#include "tests/conformance/run.h"

#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <utility>

#include "tests/conformance/forked.h"

namespace kaamos::conformance {

namespace {

RuleResult result_without_run(const Rule& rule) {
  if (rule.not_offered != nullptr) return {&rule, Outcome::kNotOffered, rule.not_offered};
  if (rule.not_applicable != nullptr) return {&rule, Outcome::kNotApplicable, rule.not_applicable};
  if (rule.tag == 'F') {
    return {&rule, Outcome::kNotApplicable, "implementations are free here; nothing is asserted"};
  }
  return {&rule, Outcome::kNotTested, ""};
}

}  // namespace

std::vector<Section> all_sections() {
  return {{"sbt", sbt_tests()},
          {"sbt_undefined", sbt_undefined_tests()},
          {"root", root_tests()},
          {"flg", flg_tests()},
          {"flg_legality", flg_legality_tests()},
          {"trv", trv_tests()},
          {"trv_any_hit", trv_any_hit_tests()},
          {"trv_inactive", trv_inactive_tests()},
          {"trv_random", trv_random_tests()},
          {"trv_report", trv_report_tests()},
          {"trv_edge", trv_edge_tests()},
          {"sv", sv_tests()},
          {"pay", pay_tests()},
          {"pay_qualifier", pay_qualifier_tests()},
          {"rq", rq_tests()},
          {"ser", ser_tests()},
          {"ser_compile", ser_compile_tests()},
          {"omm", omm_tests()},
          {"omm_build", omm_build_tests()},
          {"top", top_tests()},
          {"ptl", ptl_tests()},
          {"cls", cls_tests()},
          {"so", so_tests()},
          {"so_collection", so_collection_tests()},
          {"so_object", so_object_tests()},
          {"dsp", dsp_tests()},
          {"as_build", as_build_tests()},
          {"as_memory", as_memory_tests()},
          {"as_info", as_info_tests()},
          {"as_update", as_update_tests()},
          {"as_copy", as_copy_tests()},
          {"err", err_tests()},
          {"ras_assembler", ras_assembler_tests()},
          {"ras_element", ras_element_tests()},
          {"ras_link", ras_link_tests()},
          {"ras_clip", ras_clip_tests()},
          {"ras_viewport", ras_viewport_tests()},
          {"ras_coverage", ras_coverage_tests()},
          {"ras_lines", ras_line_tests()},
          {"ras_sources", ras_source_tests()},
          {"ras_geometry", ras_geometry_tests()},
          {"ras_depth", ras_depth_tests()},
          {"ras_attribute", ras_attribute_tests()},
          {"ras_quad", ras_quad_tests()},
          {"ras_lod", ras_lod_tests()},
          {"ras_order", ras_order_tests()},
          {"ras_output", ras_output_tests()},
          {"ras_blend", ras_blend_tests()},
          {"ras_clear", ras_clear_tests()},
          {"ras_draw", ras_draw_tests()},
          {"ras_random", ras_random_tests()}};
}

std::vector<RuleTest> all_tests() {
  std::vector<RuleTest> out;
  for (const Section& section : all_sections()) {
    out.insert(out.end(), section.tests.begin(), section.tests.end());
  }
  return out;
}

bool test_covers(const RuleTest& test, std::string_view rule) {
  std::string_view rest = test.rules;
  while (!rest.empty()) {
    const size_t comma = rest.find(", ");
    if (rest.substr(0, comma) == rule) return true;
    rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 2);
  }
  return false;
}

bool may_provoke(const RuleTest& test, std::string_view report) {
  const std::string_view allowed = test.provokes;
  return allowed == "*" || allowed.find(report.substr(0, 6)) != std::string_view::npos;
}

bool refused_by_tier(const std::string& failures, rtapi::RaytracingTier tier) {
  using rtapi::RaytracingTier;
  const auto has = [&](const char* id) { return failures.find(id) != std::string::npos; };
  if (tier < RaytracingTier::kTier1_0 && has("KA0545")) return true;
  if (tier < RaytracingTier::kTier1_2 && (has("KA0546") || has("from tier 1.2 on"))) return true;
  return tier < RaytracingTier::kTier1_1 &&
         (has("KA0520") || has("KA0541") || has("KA0542") || has("needs tier 1.1"));
}

std::string run_here(const RuleTest& test, const Target& target) {
  std::string out;
  try {
    Context context(target);
    try {
      test.run(context);
    } catch (const rtapi::ResultError& error) {
      context.fail(error.error().message);
    }
    if (const auto removed = context.device().GetDeviceRemovedReason(); !removed) {
      context.fail("device removed: " + removed.error().message);
    }
    for (const std::string& failure : context.failures()) out += failure + "\n";
    for (const std::string& report : context.reports()) {
      if (!may_provoke(test, report)) out += "checked mode says: " + report + "\n";
    }
  } catch (const std::exception& error) {
    out += std::string(error.what()) + "\n";
  }
  return out;
}

void run_apart(const std::vector<RuleTest>& tests, const Target& target,
               const std::function<void(size_t index, const std::string& failures)>& on_result) {
  size_t next = 0;
  bool repeated = false;
  while (next < tests.size()) {
    const End end = fork_and_run(
        tests.size() - next, [&](size_t i) { return run_here(tests[next + i], target); },
        [&](size_t i, const std::string& text) { on_result(next + i, text); });
    next += end.done;
    if (next == tests.size()) break;
    if (end.done > 0) repeated = false;
    if (target.backend == "vulkan" && WIFSIGNALED(end.status) && !repeated) {
      repeated = true;
      continue;
    }
    repeated = false;
    on_result(next++, describe_end(end.status));
  }
}

DeviceCheck check_device(const Target& target) {
  std::string text;
  const End end = fork_and_run(
      1,
      [&](size_t) -> std::string {
        const auto device = rtapi::CreateDevice(target.device_desc());
        return device ? "+" + device->GetInfo().Name : "-" + device.error().message;
      },
      [&](size_t, const std::string& found) { text = found; });
  if (text.empty()) return {"", describe_end(end.status)};
  if (text[0] == '-') return {"", text.substr(1)};
  return {text.substr(1), ""};
}

namespace {

// All tests of the chosen rules, in the rules' order; each appears once, even if it covers several.
std::vector<RuleTest> tests_of(const std::string& filter) {
  std::vector<RuleTest> out;
  const std::vector<RuleTest> tests = all_tests();
  for (const Rule& rule : all_rules()) {
    if (!is_chosen(rule, filter)) continue;
    for (const RuleTest& test : tests) {
      const auto same = [&](const RuleTest& each) { return each.run == test.run; };
      if (test_covers(test, rule.id) && std::none_of(out.begin(), out.end(), same)) {
        out.push_back(test);
      }
    }
  }
  return out;
}

// What the device lacks, if it refused the test's shaders for that; else empty.
std::string lacking(const std::string& failures) {
  if (failures.rfind("KA0963 ", 0) == 0) {
    return "the device has no VK_KHR_ray_query, which the test needs";
  }
  return "";
}

RuleResult result_of(const Rule& rule, const std::vector<RuleTest>& tests,
                     const std::vector<std::string>& failures, const std::vector<double>& seconds,
                     const Target& target, const std::string& device_name) {
  RuleResult result = result_without_run(rule);
  std::string lacks;
  bool refused = false;
  for (size_t i = 0; i < tests.size(); ++i) {
    if (!test_covers(tests[i], rule.id)) continue;
    if (std::string lacked = lacking(failures[i]); !lacked.empty()) {
      lacks = std::move(lacked);
      continue;
    }
    if (refused_by_tier(failures[i], target.tier)) {
      refused = true;
      continue;
    }
    if (result.outcome != Outcome::kFailed && result.outcome != Outcome::kPassed) {
      result.outcome = Outcome::kPassed;
      result.detail.clear();
    }
    if (!failures[i].empty()) result.outcome = Outcome::kFailed;
    result.detail += failures[i];
    result.seconds += seconds[i];
  }
  if (!lacks.empty() && result.outcome != Outcome::kFailed) {
    return {&rule, Outcome::kNotOffered, lacks};
  }
  if (refused && result.outcome != Outcome::kFailed) return {&rule, Outcome::kRefused};
  if (result.outcome != Outcome::kFailed) return result;
  if (const Deviation* known = find_deviation(rule.id, target.name(), device_name)) {
    result.outcome = Outcome::kKnownDeviation;
    result.detail = std::string(known->reason) + "\n" + result.detail;
  }
  return result;
}

}  // namespace

std::vector<RuleResult> run_rules(
    const Target& target, const std::string& device_name, const std::string& filter,
    const std::function<void(const RuleResult& result)>& on_result,
    const std::function<void(const Progress& progress)>& on_progress) {
  using Clock = std::chrono::steady_clock;
  const std::vector<RuleTest> tests = tests_of(filter);
  std::vector<std::string> failures(tests.size());
  std::vector<double> seconds(tests.size());
  std::vector<RuleResult> out;
  auto rule = all_rules().begin();
  // Reports the rules whose tests are all done; `done` counts tests.
  const auto tell = [&](size_t done) {
    for (; rule != all_rules().end(); ++rule) {
      if (!is_chosen(*rule, filter)) continue;
      for (size_t i = done; i < tests.size(); ++i) {
        if (test_covers(tests[i], rule->id)) return;
      }
      out.push_back(result_of(*rule, tests, failures, seconds, target, device_name));
      if (on_result) on_result(out.back());
    }
  };
  const auto begin = [&](size_t next) {
    if (on_progress && next < tests.size()) on_progress({next, tests.size(), tests[next].rules});
  };
  Clock::time_point start = Clock::now();
  begin(0);
  run_apart(tests, target, [&](size_t index, const std::string& text) {
    const Clock::time_point end = Clock::now();
    failures[index] = text;
    seconds[index] = std::chrono::duration<double>(end - std::exchange(start, end)).count();
    tell(index + 1);
    begin(index + 1);
  });
  tell(tests.size());
  return out;
}

}  // namespace kaamos::conformance
