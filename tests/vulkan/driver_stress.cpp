// SPDX-License-Identifier: MIT
//
// driver_stress [--seconds N] [--shape NAME] [--seed N]: uses the Vulkan driver over and over in
// the ways ("shapes") in which the backend uses it, each time in a process of its own, and prints
// how often each shape crashed, hung or gave a wrong result. Without --seconds it runs for 5 s, or
// 600 s under KAAMOS_FULL=1. Without a device it says so and exits with 77, or with 1 under
// KAAMOS_REQUIRE_VULKAN=1.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>
#include <string>
#include <thread>

#include "tests/vulkan/raw_gpu.h"
#include "tests/vulkan/stress_shapes.h"

namespace {

constexpr int kSkipped = 77;
constexpr int kWrong = 3;
constexpr int kThrew = 4;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Runs `work` in a child process. Returns waitpid's status, or -1 if the child had to be killed.
template <class Work>
int in_child(Work work, double limit_seconds) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const int code = work();
    std::fflush(nullptr);
    _exit(code);
  }
  const double end = now() + limit_seconds;
  for (int status = 0;;) {
    if (waitpid(child, &status, WNOHANG) == child) return status;
    if (now() > end) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return -1;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

int open_device() {
  try {
    raw::Gpu gpu;
    std::printf("driver: %s\n", gpu.name().c_str());
    return 0;
  } catch (const std::exception& error) {
    std::printf(
        "no Vulkan device with ray tracing pipelines: %s. Install mesa-vulkan-drivers 24.3 or "
        "newer (Debian 12: apt-get install -t bookworm-backports mesa-vulkan-drivers).\n",
        error.what());
    return kSkipped;
  }
}

int run_shape(const stress::Shape& shape, uint32_t seed, double seconds) {
  try {
    const std::string problem = shape.run(seed, seconds);
    if (problem.empty()) return 0;
    std::printf("%s, seed %u: wrong: %s\n", shape.name, seed, problem.c_str());
    return kWrong;
  } catch (const std::exception& error) {
    std::printf("%s, seed %u: %s\n", shape.name, seed, error.what());
    return kThrew;
  }
}

struct Tally {
  int runs = 0, crashes = 0, hangs = 0, wrong = 0, errors = 0;
};

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value && std::strcmp(value, "1") == 0;
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = is_set("KAAMOS_FULL") ? 600 : 5;
  const char* only = nullptr;
  uint32_t seed = 1;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--seconds") == 0) seconds = std::atof(argv[i + 1]);
    if (std::strcmp(argv[i], "--shape") == 0) only = argv[i + 1];
    if (std::strcmp(argv[i], "--seed") == 0) seed = static_cast<uint32_t>(std::atol(argv[i + 1]));
  }
  const int opened = in_child(open_device, 60);
  if (!WIFEXITED(opened) || WEXITSTATUS(opened) != 0) {
    return is_set("KAAMOS_REQUIRE_VULKAN") ? 1 : kSkipped;
  }
  std::map<std::string, Tally> tallies;
  const double end = now() + seconds;
  const double slice = std::min(seconds / 50, 4.0);
  // Every shape runs once regardless of the time, then they repeat until it is over.
  for (bool first = true; first || now() < end; first = false) {
    for (const stress::Shape& shape : stress::shapes()) {
      if (only && std::strcmp(only, shape.name) != 0) continue;
      if (!first && now() >= end) break;
      Tally& tally = tallies[shape.name];
      const int status = in_child([&] { return run_shape(shape, seed, slice); }, slice + 90);
      ++tally.runs;
      if (status == -1) {
        ++tally.hangs;
        std::printf("%s, seed %u: did not end\n", shape.name, seed);
      } else if (WIFSIGNALED(status)) {
        ++tally.crashes;
        std::printf("%s, seed %u: ended by signal %d\n", shape.name, seed, WTERMSIG(status));
      } else if (WEXITSTATUS(status) == kWrong) {
        ++tally.wrong;
      } else if (WEXITSTATUS(status) != 0) {
        ++tally.errors;
      }
      ++seed;
    }
  }
  std::printf("%-28s %6s %8s %6s %6s %6s\n", "shape", "runs", "crashes", "hangs", "wrong",
              "errors");
  bool good = true;
  for (const auto& [name, tally] : tallies) {
    std::printf("%-28s %6d %8d %6d %6d %6d\n", name.c_str(), tally.runs, tally.crashes, tally.hangs,
                tally.wrong, tally.errors);
    good &= tally.crashes + tally.hangs + tally.wrong + tally.errors == 0;
  }
  return good ? 0 : 1;
}
