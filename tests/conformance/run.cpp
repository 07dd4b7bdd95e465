// SPDX-License-Identifier: MIT
#include "tests/conformance/run.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <functional>
#include <map>

namespace kaamos::conformance {

namespace {

constexpr unsigned kLimitSeconds = 120;

struct Child {
  std::string text = {};
  int status = 0;  // waitpid's
};

// Runs `work` in a forked process; its text comes back through a pipe.
Child fork_and_run(const std::function<std::string()>& work) {
  int ends[2];
  if (pipe(ends) != 0) return {"no pipe to a process of its own", 0};
  const pid_t child = fork();
  if (child < 0) return {"no process of its own", 0};
  if (child == 0) {
    close(ends[0]);
    alarm(kLimitSeconds);
    const std::string text = work();
    for (size_t done = 0; done < text.size();) {
      const ssize_t count = write(ends[1], text.data() + done, text.size() - done);
      if (count <= 0) _exit(1);
      done += static_cast<size_t>(count);
    }
    _exit(0);
  }
  close(ends[1]);
  Child out;
  char buffer[4096];
  for (ssize_t count; (count = read(ends[0], buffer, sizeof buffer)) > 0;) {
    out.text.append(buffer, static_cast<size_t>(count));
  }
  close(ends[0]);
  waitpid(child, &out.status, 0);
  return out;
}

std::string describe_end(int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    return "did not end within " + std::to_string(kLimitSeconds) + " s\n";
  }
  if (WIFSIGNALED(status)) return std::string("ended by ") + strsignal(WTERMSIG(status)) + "\n";
  return "";
}

RuleResult result_without_run(const Rule& rule) {
  if (rule.not_applicable != nullptr) return {&rule, Outcome::kNotApplicable, rule.not_applicable};
  if (rule.tag == 'F') {
    return {&rule, Outcome::kNotApplicable, "implementations are free here; nothing is asserted"};
  }
  return {&rule, Outcome::kNotTested, ""};
}

}  // namespace

std::vector<RuleTest> all_tests() {
  std::vector<RuleTest> out;
  for (const auto& section : {sbt_tests(),         sbt_undefined_tests(), root_tests(),
                              flg_tests(),         flg_legality_tests(),  trv_tests(),
                              trv_any_hit_tests(), trv_inactive_tests(),  trv_random_tests(),
                              trv_report_tests(),  trv_edge_tests(),      sv_tests(),
                              pay_tests(),         pay_qualifier_tests(), rq_tests(),
                              so_tests(),          so_collection_tests(), so_object_tests(),
                              dsp_tests(),         as_build_tests(),      as_memory_tests(),
                              as_info_tests(),     as_update_tests(),     as_copy_tests(),
                              err_tests()}) {
    out.insert(out.end(), section.begin(), section.end());
  }
  return out;
}

bool test_covers(const RuleTest& test, std::string_view rule) {
  return std::string_view(test.rules).find(rule) != std::string_view::npos;
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
  } catch (const std::exception& error) {
    out += std::string(error.what()) + "\n";
  }
  return out;
}

std::string run_apart(const RuleTest& test, const Target& target) {
  const auto work = [&] { return run_here(test, target); };
  Child child = fork_and_run(work);
  if (target.backend == "vulkan" && WIFSIGNALED(child.status)) child = fork_and_run(work);
  return child.text + describe_end(child.status);
}

DeviceCheck check_device(const Target& target) {
  const Child child = fork_and_run([&]() -> std::string {
    rtapi::DeviceDesc desc;
    desc.Backend = target.backend;
    desc.Precision = target.precision;
    const auto device = rtapi::CreateDevice(desc);
    return device ? "+" + device->GetInfo().Name : "-" + device.error().message;
  });
  if (child.text.empty()) return {"", describe_end(child.status)};
  if (child.text[0] == '-') return {"", child.text.substr(1)};
  return {child.text.substr(1), ""};
}

std::vector<RuleResult> run_rules(const Target& target, const std::string& device_name,
                                  const std::string& filter,
                                  void (*on_result)(const RuleResult& result)) {
  const std::vector<RuleTest> tests = all_tests();
  std::map<void (*)(Context&), std::string> done;  // one test may cover several rules
  std::vector<RuleResult> out;
  for (const Rule& rule : all_rules()) {
    if (std::string_view(rule.id).substr(0, filter.size()) != filter) continue;
    RuleResult result = result_without_run(rule);
    for (const RuleTest& test : tests) {
      if (!test_covers(test, rule.id)) continue;
      const auto [entry, first] = done.try_emplace(test.run);
      if (first) entry->second = run_apart(test, target);
      if (result.outcome != Outcome::kFailed) result.outcome = Outcome::kPassed;
      if (!entry->second.empty()) result.outcome = Outcome::kFailed;
      result.detail += entry->second;
    }
    if (result.outcome == Outcome::kFailed) {
      if (const Deviation* known = find_deviation(rule.id, target.name(), device_name)) {
        result.outcome = Outcome::kKnownDeviation;
        result.detail = std::string(known->reason) + "\n" + result.detail;
      }
    }
    if (on_result != nullptr) on_result(result);
    out.push_back(std::move(result));
  }
  return out;
}

}  // namespace kaamos::conformance
