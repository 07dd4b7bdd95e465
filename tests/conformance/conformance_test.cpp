// SPDX-License-Identifier: MIT
//
// Every test of a rule, on each backend, as a ctest test.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <iostream>
#include <limits>
#include <set>

#include "tests/conformance/report.h"
#include "tests/conformance/rules_hold.h"
#include "tests/conformance/walker.h"

namespace kaamos::conformance {
namespace {

const bool kRegistered = [] {
  Target exact;
  exact.precision = rtapi::TraversalPrecision::kExact;
  Target vulkan;
  vulkan.backend = "vulkan";
  for (const Target& target : {Target(), exact, vulkan}) {
    std::string suite = "Conformance_" + target.name();
    std::replace(suite.begin(), suite.end(), '/', '_');
    for (const Section& section : all_sections()) {
      if (std::string_view(section.name) == "ras_random") continue;  // in ras_random_test.cpp
      testing::RegisterTest(suite.c_str(), section.name, nullptr, nullptr, __FILE__, __LINE__,
                            [=]() -> RulesHold* { return new RulesHold(section, target); });
    }
  }
  // Checked mode reports nothing about correct programs. On Vulkan only some of the rules run,
  // since drivers take seconds to compile a checked pipeline; `kaamos-conformance --checked` runs
  // all of them.
  for (Target target : {Target(), vulkan}) {
    const std::string suite = "Checked_" + target.backend;
    target.checked = true;
    const std::set<std::string> on_vulkan = {"sbt", "root", "flg_legality", "dsp"};
    for (const Section& section : all_sections()) {
      if (target.backend == "vulkan" && on_vulkan.count(section.name) == 0) continue;
      if (std::string_view(section.name) == "ras_random") continue;
      testing::RegisterTest(suite.c_str(), section.name, nullptr, nullptr, __FILE__, __LINE__,
                            [=]() -> RulesHold* { return new RulesHold(section, target); });
    }
  }
  return true;
}();

TEST(ConformanceList, AFalseAlarmOfCheckedModeFailsTheRule) {
  RuleTest test = {"TRV-59", [](Context& t) {
                     Geometry wrong = triangle(5);
                     wrong.vertices[1] = std::numeric_limits<float>::quiet_NaN();
                     t.bottom_level({wrong});
                   }};
  Target checked;
  EXPECT_EQ(run_here(test, checked), "");
  checked.checked = true;
  EXPECT_EQ(run_here(test, checked).find("checked mode says: KA0473 NaN in a vertex"), 0u);
  test.provokes = "KA0470, KA0473";
  EXPECT_EQ(run_here(test, checked), "");
}

TEST(ConformanceList, EveryTestNamesRulesOfTheList) {
  EXPECT_TRUE(kRegistered);
  std::set<void (*)(Context&)> seen;
  for (const RuleTest& test : all_tests()) {
    EXPECT_TRUE(seen.insert(test.run).second) << "a test of " << test.rules << " is there twice";
  }
  for (const RuleTest& test : all_tests()) {
    std::string rules = test.rules;
    for (size_t at = 0; at < rules.size();) {
      const size_t comma = std::min(rules.find(", ", at), rules.size());
      const std::string id = rules.substr(at, comma - at);
      const Rule* rule = find_rule(id);
      ASSERT_NE(rule, nullptr) << id;
      EXPECT_EQ(rule->not_applicable, nullptr) << id;
      EXPECT_EQ(rule->not_offered, nullptr) << id;
      at = comma + 2;
    }
  }
}

TEST(ConformanceList, AFailureSaysWhatWasFoundAndExpected) {
  const RuleTest test = {"SBT-01", [](Context& t) {
                           t.equal("answer", 41u, 42u);
                           t.refused("nothing", rtapi::Status());
                         }};
  EXPECT_EQ(run_here(test, {}), "answer: 41, expected 42\nnothing: accepted, expected an error\n");
}

TEST(ConformanceList, ACrashFailsTheTestAlone) {
  const std::vector<RuleTest> tests = {{"SBT-01", [](Context&) {}},
                                       {"SBT-02", [](Context&) { std::raise(SIGKILL); }},
                                       {"SBT-03", [](Context& t) { t.fail("seen"); }}};
  std::vector<std::string> found;
  run_apart(tests, {}, [&](size_t index, const std::string& failures) {
    EXPECT_EQ(index, found.size());
    found.push_back(failures);
  });
  EXPECT_EQ(found, (std::vector<std::string>{"", "ended by Killed\n", "seen\n"}));
}

// Drivers take seconds to compile a checked pipeline: one for each test would add up to minutes.
TEST(ConformanceList, ProgramsThatAreAlikeShareTheirPipeline) {
  Context t({});
  for (int i = 0; i < 2; ++i) {
    Standard standard(t);
    standard.create();
    Walker walker(t);
    walker.create();
    EXPECT_EQ(t.pipelines().size(), 2u);
  }
  Walker other(t);
  other.set_pipeline_flags(rtapi::RaytracingPipelineFlags::kSkipTriangles);
  other.create();
  EXPECT_EQ(t.pipelines().size(), 3u);
}

TEST(ConformanceList, ProgressNamesTheTestThatRuns) {
  Target vulkan;
  vulkan.backend = "vulkan";
  EXPECT_EQ(line_of(vulkan, {41, 262, "FLG-02"}), "vulkan: 41 of 262 tests, now FLG-02");
  std::vector<std::string> seen;
  const auto note = [&](const Progress& now) {
    seen.push_back(std::to_string(now.done) + "/" + std::to_string(now.total) + " " + now.now);
  };
  const auto results = run_rules({}, "", "ERR-3", nullptr, note);
  ASSERT_FALSE(seen.empty());
  EXPECT_EQ(seen.front().substr(0, 2), "0/");
  EXPECT_EQ(seen.front().substr(seen.front().size() - 6), "ERR-30");
  for (const RuleResult& result : results) EXPECT_GE(result.seconds, 0);
}

TEST(ConformanceList, FiltersAreBeginningsOfNumbers) {
  const Rule rule = {"SBT-12", 'R', "a rule"};
  for (const char* filter : {"", "S", "SBT-1", "SBT-12", "TRV-,SBT-12", "SBT-12,TRV-"}) {
    EXPECT_TRUE(is_chosen(rule, filter)) << filter;
  }
  for (const char* filter : {"SBT-2", "SBT-123", "BT", "TRV-,SBT-13"}) {
    EXPECT_FALSE(is_chosen(rule, filter)) << filter;
  }
  EXPECT_EQ(first_unknown("SBT-,TRV-2"), std::nullopt);
  EXPECT_EQ(first_unknown("SBT-,XYZ,ABC"), "XYZ");
}

TEST(ConformanceList, NumbersAreUnique) {
  std::set<std::string> seen;
  for (const Rule& rule : all_rules()) EXPECT_TRUE(seen.insert(rule.id).second) << rule.id;
}

}  // namespace
}  // namespace kaamos::conformance
