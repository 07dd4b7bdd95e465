// SPDX-License-Identifier: MIT
// ppl.h: every call once, and what the calls throw.
#include <ppl.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <stdexcept>
#include <vector>

namespace kaamos::d3d12 {
namespace {

using testing::Each;
using testing::ElementsAre;

TEST(ParallelPatterns, ForCallsEachIndexOnce) {
  std::vector<int> calls(1000);
  concurrency::parallel_for(size_t{0}, calls.size(), [&](size_t i) { ++calls[i]; });
  EXPECT_THAT(calls, Each(1));
}

TEST(ParallelPatterns, ForTakesSignedBoundsAndSteps) {
  std::array<int, 9> calls{};
  Concurrency::parallel_for(-4, 5, 3, [&](int i) { ++calls[size_t(i + 4)]; });
  EXPECT_THAT(calls, ElementsAre(1, 0, 0, 1, 0, 0, 1, 0, 0));
  concurrency::parallel_for(5, -4, [&](int) { FAIL(); });
}

TEST(ParallelPatterns, ForEachHandsOutReferences) {
  std::vector<int> numbers = {1, 2, 3};
  concurrency::parallel_for_each(numbers.begin(), numbers.end(), [](int& n) { n *= 2; });
  EXPECT_THAT(numbers, ElementsAre(2, 4, 6));
}

TEST(ParallelPatterns, InvokeCallsEachFunction) {
  std::atomic<int> sum{0};
  concurrency::parallel_invoke([&] { sum += 1; }, [&] { sum += 2; }, [&] { sum += 4; });
  EXPECT_EQ(sum, 7);
}

TEST(ParallelPatterns, ThrowsWhatACallThrew) {
  const auto loop = [] {
    concurrency::parallel_for(0, 100, [](int i) {
      if (i == 7) throw std::runtime_error("seven");
    });
  };
  EXPECT_THROW(loop(), std::runtime_error);
}

}  // namespace
}  // namespace kaamos::d3d12
