// SPDX-License-Identifier: MIT
#include "effects/assets/image/pareto.h"

#include <gtest/gtest.h>

#include <limits>

namespace kaamos::effects {
namespace {

TEST(Pareto, TheFrontIsWhatNothingBeats) {
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<Trade> trades = {{3, 0.1}, {1, 0.5}, {2, 0.5},   {2, 0.3}, {9, 0.1},
                                     {1, 0.5}, {inf, 0}, {0.5, inf}, {4, 0.05}};
  EXPECT_EQ(pareto_front(trades), (std::vector<std::size_t>{1, 3, 0, 8}));
  EXPECT_TRUE(pareto_front({}).empty());
}

TEST(Pareto, ForAnErrorTheCheapestIsTaken) {
  const std::vector<Trade> trades = {{3, 0.1}, {1, 0.5}, {2, 0.3}, {9, 0.1}, {4, 0.05}};
  EXPECT_EQ(cheapest_within(trades, 0.6), 1u);
  EXPECT_EQ(cheapest_within(trades, 0.3), 2u);
  EXPECT_EQ(cheapest_within(trades, 0.1), 0u);
  EXPECT_EQ(cheapest_within(trades, 0.01), trades.size());
}

}  // namespace
}  // namespace kaamos::effects
