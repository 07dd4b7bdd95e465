// SPDX-License-Identifier: MIT
//
// kaamos-verify: checks an installed copy in less than a minute, and prints what a bug report
// needs.
#include <rtapi/version.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "tests/verify/checks.h"
#include "tests/verify/facts.h"

namespace {

using namespace kaamos::verify;

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kPassed:
      return "pass";
    case Outcome::kAbsent:
      return "absent";
    case Outcome::kFailed:
      break;
  }
  return "FAIL";
}

// "pass    embree: picture    2984 of ... (0.1 s)"; further lines are indented.
void print(const Finding& finding) {
  std::istringstream lines(finding.detail);
  std::string line;
  std::getline(lines, line);
  std::printf("  %-6s  %-16s  %s", name_of(finding.outcome), finding.what.c_str(), line.c_str());
  if (finding.seconds > 0) std::printf(" (%.1f s)", finding.seconds);
  std::printf("\n");
  while (std::getline(lines, line)) std::printf("    %s\n", line.c_str());
  std::fflush(stdout);
}

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && std::strcmp(value, "1") == 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> required;
  CLI::App app(
      "Checks this copy of Kaamos: both backends, a picture with known values, ten rules of DXR, "
      "shaders "
      "interpreted and as native code. Prints what a bug report needs. Exit status: 0 if nothing "
      "failed, else 1.");
  app.set_version_flag("--version", std::string("kaamos-verify ") + rtapi::GetVersion());
  app.add_option(
         "--require", required,
         "fail where this is absent: vulkan, compiler (KAAMOS_REQUIRE_VULKAN=1 is --require "
         "vulkan)")
      ->delimiter(',')
      ->check(CLI::IsMember({"vulkan", "compiler"}));
  CLI11_PARSE(app, argc, argv);
  const auto requires_it = [&](const char* what) {
    return std::find(required.begin(), required.end(), what) != required.end();
  };
  const Settings settings = {
      .require_vulkan = requires_it("vulkan") || is_set("KAAMOS_REQUIRE_VULKAN"),
      .require_compiler = requires_it("compiler")};

  std::printf("Machine\n");
  for (const auto& [name, value] : machine_facts()) {
    std::printf("  %-16s  %s\n", name.c_str(), value.c_str());
  }
  std::printf("Checks\n");
  std::fflush(stdout);
  const auto findings = run_checks(settings, print);
  const auto failed = std::count_if(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.outcome == Outcome::kFailed;
  });
  if (failed == 0) {
    std::printf("This copy works.\n");
  } else {
    std::printf("%d of %d checks failed. A bug report needs all of the above.\n",
                static_cast<int>(failed), static_cast<int>(findings.size()));
  }
  return failed == 0 ? 0 : 1;
}
