// SPDX-License-Identifier: MIT
//
// kaamos-isolate [--limit SECONDS] [--share TESTS] [--under WORD]... PROGRAM [ARGUMENTS]: ctest
// starts tests through this program, one test in each process, or with --share several
// (shared_runs.h). The words of --under stand before the program: an emulator, for tests that were
// built for another processor.
//
// A test on Vulkan (with "vulkan" in its own name or its program's) that a signal ends, or that is
// not done within the limit, is run once more, because some of the driver's faults come and go. A
// test that fails is not repeated. KAAMOS_VULKAN_RUNS, a file in the build folder, gets a line
// "ran<TAB>name" for each such test and "repeated<TAB>name<TAB>why" for each repetition;
// scripts/test fails for more than 1 in 100. Validation layers are on and the driver's shader cache
// is in the build folder, unless the environment says otherwise. KAAMOS_TEST_COSTS, if set, is a
// file that gets a line "processor seconds<TAB>program<TAB>name".
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "child_process.h"
#include "shared_runs.h"

namespace {

using namespace kaamos::test;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string file_name(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

// A single write keeps the lines of tests that run at the same time whole.
void append(const char* file, const std::string& line) {
  const int log = open(file, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  if (log < 0) return;
  if (write(log, line.data(), line.size()) < 0) std::perror("kaamos-isolate");
  close(log);
}

void log_run(const std::string& line) {
  const char* file = std::getenv("KAAMOS_VULKAN_RUNS");
  append(file ? file : KAAMOS_BINARY_DIR "/vulkan-runs.txt", line);
}

double seconds(const timeval& time) {
  return double(time.tv_sec) + double(time.tv_usec) * 1e-6;
}

// The processor time of all processes that were started for this test. Called at exit.
std::string cost_line;
void log_cost() {
  const char* file = std::getenv("KAAMOS_TEST_COSTS");
  rusage used = {};
  if (file == nullptr || getrusage(RUSAGE_CHILDREN, &used) != 0) return;
  append(file, std::to_string(seconds(used.ru_utime) + seconds(used.ru_stime)) + cost_line);
}

}  // namespace

int main(int argc, char** argv) {
  int first = 1;
  double limit_seconds = 120;
  size_t share = 0;
  std::vector<char*> command;
  for (; first + 1 < argc; first += 2) {
    if (std::strcmp(argv[first], "--limit") == 0) {
      limit_seconds = std::atof(argv[first + 1]);
    } else if (std::strcmp(argv[first], "--share") == 0) {
      share = std::strtoul(argv[first + 1], nullptr, 10);
    } else if (std::strcmp(argv[first], "--under") == 0) {
      command.push_back(argv[first + 1]);
    } else {
      break;
    }
  }
  if (first >= argc) {
    std::fprintf(
        stderr,
        "usage: kaamos-isolate [--limit SECONDS] [--share TESTS] [--under WORD]... PROGRAM "
        "[ARGUMENTS]\n");
    return 2;
  }
  command.insert(command.end(), argv + first, argv + argc);
  command.push_back(nullptr);
  std::string name = file_name(argv[first]);
  bool on_vulkan = lower(name).find("vulkan") != std::string::npos;
  for (int i = first + 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--gtest_list_tests") == 0) {
      execvp(command[0], command.data());
      std::perror(command[0]);
      return 127;
    }
    if (std::strncmp(argv[i], "--gtest_filter=", 15) == 0) name = argv[i] + 15;
  }
  cost_line = "\t" + file_name(argv[first]) + "\t" + name + "\n";
  std::atexit(log_cost);
  on_vulkan = on_vulkan || lower(name).find("vulkan") != std::string::npos;
  setenv("MESA_SHADER_CACHE_DIR", KAAMOS_BINARY_DIR "/mesa-cache", 0);
  setenv("KAAMOS_VULKAN_VALIDATION", "1", 0);

  const char* folder = std::getenv("KAAMOS_SHARED_RUNS");
  if (share > 1 && folder != nullptr) {
    SharedRuns runs(std::string(folder) + "/" + file_name(argv[first]),
                    {command.begin(), command.end() - 1}, share, limit_seconds);
    const auto result = runs.result_of(name);
    for (const std::string& crash : runs.crashes()) {
      if (on_vulkan) log_run("repeated\t" + name + "\t" + crash + "\n");
    }
    if (result) {
      if (on_vulkan) log_run("ran\t" + name + "\n");
      std::fputs(result->output.c_str(), stdout);
      return result->passed ? 0 : 1;
    }
  }

  int status = run(command.data(), limit_seconds);
  if (on_vulkan) {
    std::string lines = "ran\t" + name + "\n";
    if (crashed(status)) {
      const std::string why = describe(status, limit_seconds);
      std::printf("\nkaamos-isolate: %s %s; it is run once more\n", name.c_str(), why.c_str());
      std::fflush(stdout);
      lines += "repeated\t" + name + "\t" + why + "\n";
      status = run(command.data(), limit_seconds);
    }
    log_run(lines);
  }
  if (crashed(status)) {
    std::printf("\nkaamos-isolate: %s %s\n", name.c_str(), describe(status, limit_seconds).c_str());
    return 1;
  }
  return WEXITSTATUS(status);
}
