// SPDX-License-Identifier: MIT
#include "effects/engine/profile.h"

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <thread>

namespace kaamos::effects {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void wait_ms(int ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

// Until the process has used this much processor time.
void work_ms(double ms) {
  const std::clock_t start = std::clock();
  while (static_cast<double>(std::clock() - start) * 1e3 / CLOCKS_PER_SEC < ms) {
  }
}

TEST(Profile, StepsTogetherTakeAsLongAsTheRun) {
  const auto before = Clock::now();
  Profile profile;
  const auto start = Clock::now();
  {
    const auto scene = Profile::enter(&profile, ProfilePart::kStart, "scene");
    wait_ms(20);
  }
  wait_ms(10);
  {
    const auto pass = Profile::enter(&profile, ProfilePart::kFrame, "pass");
    wait_ms(20);
  }
  const double total = ms_since(start);
  const auto steps = profile.steps();
  ASSERT_EQ(steps.size(), 3u);
  double sum = 0;
  for (const ProfileStep& step : steps) sum += step.wall_ms;
  EXPECT_GE(sum, total);
  EXPECT_LE(sum, ms_since(before));
  EXPECT_GE(steps[0].wall_ms, 10);
  EXPECT_EQ(steps[0].part, ProfilePart::kRest);
  EXPECT_EQ(steps[1].name, "scene");
  EXPECT_GE(steps[1].wall_ms, 20);
  EXPECT_EQ(steps[2].part, ProfilePart::kFrame);
}

TEST(Profile, AStepWithinAnotherInterruptsIt) {
  Profile profile;
  const auto start = Clock::now();
  double inner_ms = 0;
  {
    const auto outer = Profile::enter(&profile, ProfilePart::kStart, "outer");
    wait_ms(5);
    const auto inner_start = Clock::now();
    {
      const auto inner = Profile::enter(&profile, ProfilePart::kFrame, "inner");
      wait_ms(40);
    }
    inner_ms = ms_since(inner_start);
    wait_ms(5);
  }
  const double both_ms = ms_since(start);
  const auto steps = profile.steps();
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_GE(steps[1].wall_ms, 10);
  EXPECT_LE(steps[1].wall_ms, both_ms - 40);
  EXPECT_GE(steps[2].wall_ms, 40);
  EXPECT_LE(steps[2].wall_ms, inner_ms);
}

TEST(Profile, StepsOfOneNameAreALine) {
  Profile profile;
  for (int i = 0; i < 3; ++i) {
    const auto pass = Profile::enter(&profile, ProfilePart::kFrame, "pass");
  }
  { const auto other = Profile::enter(&profile, ProfilePart::kFiles, "pass"); }
  const auto steps = profile.steps();
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps[1].count, 3u);
  EXPECT_EQ(steps[2].count, 1u);
}

// Processor time counts all threads; a thread that waits takes none.
TEST(Profile, ProcessorTimeIsThatOfTheThreads) {
  Profile profile;
  {
    const auto busy = Profile::enter(&profile, ProfilePart::kFrame, "busy");
    std::thread(work_ms, 30.0).join();
  }
  {
    const auto idle = Profile::enter(&profile, ProfilePart::kFrame, "idle");
    wait_ms(30);
  }
  const auto steps = profile.steps();
  EXPECT_GE(steps[1].cpu_ms, 29);
  EXPECT_LT(steps[2].cpu_ms, 15);
  EXPECT_GE(steps[2].wall_ms, 30);
}

TEST(Profile, NoneMeasuresNothing) {
  const auto step = Profile::enter(nullptr, ProfilePart::kFrame, "pass");
}

}  // namespace
}  // namespace kaamos::effects
