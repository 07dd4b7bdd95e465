// SPDX-License-Identifier: MIT
//
// kaamos-test: runs the tests in an HLSL file.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include <rtapi/version.h>

#include "runtime/coverage/collector.h"
#include "runtime/files/write_file.h"
#include "tests/shaders/report.h"
#include "tests/shaders/session.h"

namespace {

using namespace kaamos::shader_tests;

constexpr int kPassed = 0;
constexpr int kFailed = 1;
constexpr int kCannotRun = 2;
constexpr int kSkipped = 77;  // what CTest's SKIP_RETURN_CODE is by custom

struct Options {
  SourceOptions source;
  std::vector<std::string> executors = {"interpreter"};
  std::string filter;
  std::string junit;
  std::string coverage;
  double timeout_seconds = 10;
  bool tap = false;
  bool list = false;
  bool verbose = false;
  bool watch = false;
};

// '*' stands for any text, '?' for a letter; without either, the name contains the filter. "=Name"
// is the test of that name, in whatever namespace, and its cases.
bool matches(std::string_view filter, std::string_view name) {
  if (filter.empty()) return name.empty();
  if (filter[0] == '*') {
    return matches(filter.substr(1), name) || (!name.empty() && matches(filter, name.substr(1)));
  }
  return !name.empty() && (filter[0] == '?' || filter[0] == name[0]) &&
         matches(filter.substr(1), name.substr(1));
}
bool is_wanted(const std::string& filter, const std::string& name) {
  if (filter.empty()) return true;
  if (filter[0] == '=') {
    const std::string wanted = filter.substr(1);
    const std::string_view test = std::string_view(name).substr(0, name.find('/'));
    return test == wanted || test.ends_with("::" + wanted);
  }
  if (filter.find_first_of("*?") != std::string::npos) return matches(filter, name);
  return name.find(filter) != std::string::npos;
}

int exit_code(const std::vector<TestResult>& results) {
  bool all_skipped = true;
  for (const TestResult& result : results) {
    if (result.outcome == TestResult::Outcome::kFailed) return kFailed;
    all_skipped = all_skipped && result.outcome == TestResult::Outcome::kSkipped;
  }
  return all_skipped ? kSkipped : kPassed;
}

int run(const Options& options, std::vector<std::string>& dependencies) {
  const Source source = read_source(options.source);
  dependencies = source.dependencies;
  if (!source.error.empty()) {
    std::cerr << source.error << "\n";
    return kCannotRun;
  }
  std::vector<const TestRun*> runs;
  for (const TestRun& test : source.tests.runs) {
    if (is_wanted(options.filter, test.name)) runs.push_back(&test);
  }
  if (options.list) {
    for (const TestRun* test : runs) {
      std::cout << test->name << " " << test->file << ":" << test->line << "\n";
    }
    return kPassed;
  }
  if (runs.empty()) {
    std::cerr << options.source.path << " has "
              << (source.tests.runs.empty()
                      ? "no tests: write [test] before a function that returns void"
                      : "no test of that name: --list prints all")
              << "\n";
    return kCannotRun;
  }
  std::vector<TestResult> results;
  for (const std::string& executor : options.executors) {
    SessionResult session = run_tests(source, runs, executor, options.timeout_seconds);
    if (!session.error.empty()) {
      std::cerr << session.error << "\n";
      const char* required = std::getenv("KAAMOS_REQUIRE_VULKAN");
      const bool skips = session.has_no_device && (required == nullptr || required[0] != '1');
      return skips ? kSkipped : kCannotRun;
    }
    for (TestResult& result : session.results) results.push_back(std::move(result));
  }
  std::cout << to_text(results, options.tap ? Format::kTap : Format::kPlain, options.verbose);
  std::cout << (options.tap ? "# " : "") << summary(results) << std::endl;
  if (!options.junit.empty()) {
    const int error =
        kaamos::files::write_file(options.junit, to_junit(options.source.path, results));
    if (error != 0) {
      std::cerr << "\"" << options.junit << "\" cannot be written: " << std::strerror(error)
                << "\n";
      return kCannotRun;
    }
  }
  return exit_code(results);
}

std::vector<std::filesystem::file_time_type> times_of(const std::vector<std::string>& files) {
  std::vector<std::filesystem::file_time_type> out;
  for (const std::string& file : files) {
    std::error_code ignored;
    out.push_back(std::filesystem::last_write_time(file, ignored));
  }
  return out;
}

// Runs again whenever a file changes, until it is interrupted.
[[noreturn]] void watch(const Options& options) {
  for (;;) {
    std::vector<std::string> dependencies;
    run(options, dependencies);
    const auto before = times_of(dependencies);
    while (times_of(dependencies) == before) {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    std::cout << "\n";
  }
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  std::vector<std::string> defines;
  CLI::App app{
      "Runs the tests in an HLSL file. Exit code: 0 all passed, 1 some failed, 2 they could "
      "not run, 77 all skipped, or there is no such device."};
  app.set_version_flag("--version", std::string("kaamos-test ") + rtapi::GetVersion());
  app.add_option("file", options.source.path, "HLSL with #include <kaamos/test.hlsli>")->required();
  app.add_option("--on", options.executors, "interpreter (the default), embree, vulkan")
      ->delimiter(',');
  app.add_option("--filter", options.filter,
                 "only tests whose name contains this; with * and ?, or =Name, the whole name");
  app.add_option("--junit", options.junit, "writes the results as JUnit's XML, too");
  app.add_option("--coverage", options.coverage,
                 "adds which lines and branches ran to this LCOV tracefile");
  app.add_option("--timeout", options.timeout_seconds, "seconds that one test may take")
      ->check(CLI::PositiveNumber);
  app.add_option("-I", options.source.include_folders, "folder of included files");
  app.add_option("-D", defines, "macro: NAME or NAME=VALUE");
  app.add_option("-T", options.source.target, "profile, lib_6_6 by default");
  app.add_flag("--tap", options.tap, "prints TAP");
  app.add_flag("--list", options.list, "prints the names of the tests and runs none");
  app.add_flag("--verbose", options.verbose, "prints what passing tests print, too");
  app.add_flag("--watch", options.watch, "runs again when the file or one it includes changes");
  CLI11_PARSE(app, argc, argv);
  for (const std::string& define : defines) {
    const size_t equals = define.find('=');
    options.source.defines.push_back(
        {define.substr(0, equals), equals == std::string::npos ? "1" : define.substr(equals + 1)});
  }
  for (const std::string& executor : options.executors) {
    if (is_executor(executor)) continue;
    std::cerr << "--on \"" << executor << "\": it is interpreter, embree or vulkan\n";
    return kCannotRun;
  }
  if (!options.coverage.empty()) setenv("KAAMOS_COVERAGE", options.coverage.c_str(), 1);
  if (const std::string error = kaamos::coverage::begin(); !error.empty()) {
    std::cerr << error << "\n";
    return kCannotRun;
  }
  if (options.watch) watch(options);
  std::vector<std::string> dependencies;
  return run(options, dependencies);
}
