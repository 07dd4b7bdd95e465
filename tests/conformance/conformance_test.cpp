// SPDX-License-Identifier: MIT
//
// Every test of a rule on each backend as a test of ctest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <set>

#include "tests/conformance/run.h"
#include "tests/vulkan/support.h"

namespace kaamos::conformance {
namespace {

class RulesHold : public testing::Test {
 public:
  RulesHold(RuleTest test, Target target) : test_(test), target_(std::move(target)) {}

  void TestBody() override {
    if (target_.backend == "vulkan") {
      KAAMOS_NEED_VULKAN();
      check();
    } else {
      check();
    }
  }

 private:
  void check() {
    const std::string failures = run_here(test_, target_);
    if (failures.empty()) return;
    rtapi::DeviceDesc desc;
    desc.Backend = target_.backend;
    const std::string device = rtapi::CreateDevice(desc).value().GetInfo().Name;
    const std::string first =
        std::string(test_.rules).substr(0, std::string(test_.rules).find(','));
    if (const Deviation* known = find_deviation(first, target_.name(), device)) {
      GTEST_SKIP() << "known deviation: " << known->reason;
    }
    ADD_FAILURE() << test_.rules << "\n" << failures;
  }

  RuleTest test_;
  Target target_;
};

std::string test_name(std::string rules) {
  std::replace_if(
      rules.begin(), rules.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return rules;
}

const bool kRegistered = [] {
  Target exact;
  exact.precision = rtapi::TraversalPrecision::kExact;
  Target vulkan;
  vulkan.backend = "vulkan";
  for (const Target& target : {Target(), exact, vulkan}) {
    for (const RuleTest& test : all_tests()) {
      testing::RegisterTest(test_name("Conformance_" + target.name()).c_str(),
                            test_name(test.rules).c_str(), nullptr, nullptr, __FILE__, __LINE__,
                            [=]() -> RulesHold* { return new RulesHold(test, target); });
    }
  }
  return true;
}();

TEST(ConformanceList, EveryTestNamesRulesOfTheList) {
  EXPECT_TRUE(kRegistered);
  std::set<std::string> names;  // of ctest's tests
  for (const RuleTest& test : all_tests()) {
    EXPECT_TRUE(names.insert(test.rules).second) << "two tests of " << test.rules;
  }
  for (const RuleTest& test : all_tests()) {
    std::string rules = test.rules;
    for (size_t at = 0; at < rules.size();) {
      const size_t comma = std::min(rules.find(", ", at), rules.size());
      const std::string id = rules.substr(at, comma - at);
      const Rule* rule = find_rule(id);
      ASSERT_NE(rule, nullptr) << id;
      EXPECT_EQ(rule->not_applicable, nullptr) << id;
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
  const RuleTest test = {"SBT-01", [](Context&) { std::raise(SIGKILL); }};
  EXPECT_EQ(run_apart(test, {}), "ended by Killed\n");
}

TEST(ConformanceList, NumbersAreUnique) {
  std::set<std::string> seen;
  for (const Rule& rule : all_rules()) EXPECT_TRUE(seen.insert(rule.id).second) << rule.id;
}

}  // namespace
}  // namespace kaamos::conformance
