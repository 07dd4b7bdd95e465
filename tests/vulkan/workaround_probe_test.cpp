// SPDX-License-Identifier: MIT
//
// Workarounds that change no pixel, with and without them: B11 (which thread works), PAYLOAD and
// CALLABLES (whether the process survives). Tests of the others compare pixels;
// runtime/vulkan/README.md says where they are.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "tests/vulkan/support.h"

namespace kaamos::test {
namespace {

struct Outcome {
  int status = 0;  // as in a shell: 128 + signal
  std::string line;
};

// `before`: shell commands; `what`: the program and its arguments. The probe dumps no core, and its
// validation layers are off because they have stacks and threads of their own.
Outcome probe(const std::string& what, const std::string& before) {
  const std::string command = "bash -c 'unset KAAMOS_VULKAN_VALIDATION; ulimit -c 0; " + before +
                              KAAMOS_BINARY_DIR "/bin/" + what + " 2>&1; exit $?' 2>/dev/null";
  Outcome outcome;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return outcome;
  char text[1024];
  while (std::fgets(text, sizeof(text), pipe) != nullptr) outcome.line += text;
  outcome.status = WEXITSTATUS(pclose(pipe));
  return outcome;
}

double busiest_share(const std::string& before) {
  const Outcome outcome = probe("workaround_probe balance", before);
  EXPECT_EQ(outcome.status, 0) << outcome.line;
  return std::atof(outcome.line.c_str());
}

// Work in one half of the picture keeps a thread idle that owns the other half.
TEST(VulkanWorkarounds, RowsAreSharedEvenly) {
  KAAMOS_NEED_VULKAN();
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "needs two processors";
  const double with = busiest_share("");
  const double without = busiest_share("export KAAMOS_VULKAN_DISABLE_WORKAROUNDS=B11; ");
  EXPECT_GT(without, 1.5 * with);
}

// On a CPU without AVX-512, LLVM takes minutes for a payload of 4 KiB (1.5 for 1 KiB on an EPYC Zen
// 3).
bool has_avx512() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx512f");
#else
  return false;
#endif
}
#define KAAMOS_NEED_QUICK_COMPILER()                          \
  if (!has_avx512() && std::getenv("KAAMOS_FULL") == nullptr) \
  GTEST_SKIP()                                                \
      << "the driver compiles this for minutes on a CPU without AVX-512; KAAMOS_FULL=1 runs it"

// The driver's threads get the stack size of the process's limit: with 1 MiB, 31 traces with 4 KiB
// exceed it just as 31 traces with 64 KiB exceed the usual 8 MiB, and the driver compiles the
// latter for minutes.
constexpr char kSmallStacks[] = "ulimit -s 1024; ";

TEST(VulkanWorkarounds, LargePayloadsThatNestTooDeepRemoveTheDevice) {
  KAAMOS_NEED_VULKAN();
  KAAMOS_NEED_QUICK_COMPILER();
  const Outcome with = probe("workaround_probe payload", kSmallStacks);
  EXPECT_EQ(with.status, 0);
  EXPECT_NE(with.line.find("KA0890"), std::string::npos) << with.line;
  EXPECT_NE(with.line.find("a depth of 11,"), std::string::npos) << with.line;
}

TEST(VulkanWorkarounds, LargePayloadsThatNestTooDeepEndTheProcessOtherwise) {
  KAAMOS_NEED_VULKAN();
  KAAMOS_NEED_QUICK_COMPILER();
  const Outcome without =
      probe("workaround_probe payload",
            std::string("export KAAMOS_VULKAN_DISABLE_WORKAROUNDS=PAYLOAD; ") + kSmallStacks);
  EXPECT_GE(without.status, 128) << without.line;
}

TEST(VulkanWorkarounds, UsualStacksAreLargeEnough) {
  KAAMOS_NEED_VULKAN();
  KAAMOS_NEED_QUICK_COMPILER();
  const Outcome outcome = probe("workaround_probe payload", "ulimit -s 8192; ");
  EXPECT_EQ(outcome.line, "finished: 38\n");
}

// Without a limit, threads get 2 MiB.
TEST(VulkanWorkarounds, StacksWithoutALimitAreSmaller) {
  KAAMOS_NEED_VULKAN();
  KAAMOS_NEED_QUICK_COMPILER();
  const Outcome outcome = probe("workaround_probe payload", "ulimit -s unlimited; ");
  EXPECT_EQ(outcome.status, 0) << outcome.line;
  EXPECT_NE(outcome.line.find("a depth of 23,"), std::string::npos) << outcome.line;
}

// The driver's fault behind CALLABLES, in a process without the backend.
TEST(VulkanWorkarounds, DeepCallablesNeedAFrameThatNobodyCalls) {
  KAAMOS_NEED_VULKAN();
  const Outcome few = probe("callable_probe 31", "");
  if (few.line.find("llvmpipe") == std::string::npos) GTEST_SKIP() << few.line;
  EXPECT_NE(few.line.find("\nlevels: 31 of 31\n"), std::string::npos) << few.line;
  const Outcome many = probe("callable_probe 300", "");
  EXPECT_EQ(many.line.find("\nlevels: 300"), std::string::npos) << many.line;
  const Outcome with = probe("callable_probe 300 --frame 8192", "");
  EXPECT_NE(with.line.find("\nlevels: 300 of 300\n"), std::string::npos) << with.line;
}

}  // namespace
}  // namespace kaamos::test
