// SPDX-License-Identifier: MIT
#include "tests/shaders/report.h"

#include <algorithm>
#include <cstdio>

namespace kaamos::shader_tests {
namespace {

using Outcome = TestResult::Outcome;

// The text shows this many failures of a test: every thread of a group may fail.
constexpr size_t kMostFailures = 8;

size_t count(const std::vector<TestResult>& results, Outcome outcome) {
  return static_cast<size_t>(
      std::count_if(results.begin(), results.end(),
                    [&](const TestResult& result) { return result.outcome == outcome; }));
}

std::string indented(const std::string& text, const std::string& by) {
  std::string out = by;
  for (const char c : text) {
    out += c;
    if (c == '\n') out += by;
  }
  return out + "\n";
}

// With everything escaped that XML gives a meaning, and without what it cannot hold.
std::string xml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') out += c;
        break;
    }
  }
  return out;
}

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", value);
  return text;
}

std::string plain_line(const TestResult& result) {
  const char* word = result.outcome == Outcome::kPassed   ? "PASS "
                     : result.outcome == Outcome::kFailed ? "FAIL "
                                                          : "SKIP ";
  std::string out =
      word + result.test->name + " (" + result.executor + ", " + seconds(result.seconds) + " s)";
  if (result.outcome == Outcome::kSkipped) out += ": " + result.skipped;
  return out + "\n";
}

std::string tap_line(const TestResult& result, size_t number) {
  std::string out = result.outcome == Outcome::kFailed ? "not ok " : "ok ";
  out += std::to_string(number) + " - " + result.test->name + " (" + result.executor + ")";
  if (result.outcome == Outcome::kSkipped) out += " # SKIP " + result.skipped;
  return out + "\n";
}

std::string test_case(const std::string& file, const TestResult& result) {
  std::string out = "    <testcase classname=\"" + xml(file) + "\" name=\"" +
                    xml(result.test->name) + "\" file=\"" + xml(result.test->file) + "\" line=\"" +
                    std::to_string(result.test->line) + "\" time=\"" + seconds(result.seconds) +
                    "\"";
  if (result.outcome == Outcome::kPassed && result.output.empty()) return out + "/>\n";
  out += ">\n";
  if (result.outcome == Outcome::kSkipped) {
    out += "      <skipped message=\"" + xml(result.skipped) + "\"/>\n";
  }
  for (const std::string& failure : result.failures) {
    out += "      <failure message=\"" + xml(failure.substr(0, failure.find('\n'))) + "\">" +
           xml(failure) + "</failure>\n";
  }
  if (!result.output.empty()) {
    out += "      <system-out>";
    for (const std::string& line : result.output) out += xml(line) + "\n";
    out += "</system-out>\n";
  }
  return out + "    </testcase>\n";
}

}  // namespace

std::string to_text(const std::vector<TestResult>& results, Format format, bool verbose) {
  std::string out;
  if (format == Format::kTap) out = "TAP version 13\n1.." + std::to_string(results.size()) + "\n";
  const std::string by = format == Format::kTap ? "# " : "  ";
  size_t number = 0;
  for (const TestResult& result : results) {
    out += format == Format::kTap ? tap_line(result, ++number) : plain_line(result);
    const bool shows = verbose || result.outcome == Outcome::kFailed;
    for (const std::string& line : result.output) {
      if (shows) out += indented("printf " + line, by);
    }
    for (size_t i = 0; i < std::min(result.failures.size(), kMostFailures); ++i) {
      out += indented(result.failures[i], by);
    }
    if (result.failures.size() > kMostFailures) {
      out += by + "and " + std::to_string(result.failures.size() - kMostFailures) + " more\n";
    }
  }
  return out;
}

std::string summary(const std::vector<TestResult>& results) {
  return std::to_string(results.size()) + (results.size() == 1 ? " test: " : " tests: ") +
         std::to_string(count(results, Outcome::kPassed)) + " passed, " +
         std::to_string(count(results, Outcome::kFailed)) + " failed, " +
         std::to_string(count(results, Outcome::kSkipped)) + " skipped";
}

std::string to_junit(const std::string& file, const std::vector<TestResult>& results) {
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  for (size_t begin = 0; begin < results.size();) {
    size_t end = begin;
    while (end < results.size() && results[end].executor == results[begin].executor) ++end;
    const std::vector<TestResult> suite(results.begin() + static_cast<ptrdiff_t>(begin),
                                        results.begin() + static_cast<ptrdiff_t>(end));
    double time = 0;
    for (const TestResult& result : suite) time += result.seconds;
    out += "  <testsuite name=\"" + xml(file + " (" + suite[0].executor + ")") + "\" tests=\"" +
           std::to_string(suite.size()) + "\" failures=\"" +
           std::to_string(count(suite, Outcome::kFailed)) + "\" skipped=\"" +
           std::to_string(count(suite, Outcome::kSkipped)) + "\" errors=\"0\" time=\"" +
           seconds(time) + "\">\n";
    for (const TestResult& result : suite) out += test_case(file, result);
    out += "  </testsuite>\n";
    begin = end;
  }
  return out + "</testsuites>\n";
}

}  // namespace kaamos::shader_tests
