// SPDX-License-Identifier: MIT
/// @file
/// Finds which of several ways to the same result are worth their price.
#pragma once

#include <cstddef>
#include <vector>

namespace kaamos::effects {

/// The cost of something, and how far off it is; less is better of both.
struct Trade {
  double cost = 0;   ///< any unit
  double error = 0;  ///< any unit
};

/// The indices of those that no other beats: none is both as cheap and as accurate and in one of
/// them better. By falling error. Of equals the first; what is not finite is never among them.
std::vector<std::size_t> pareto_front(const std::vector<Trade>& trades);

/// The index of the cheapest whose error is at most `error`; trades.size(): there is none.
std::size_t cheapest_within(const std::vector<Trade>& trades, double error);

}  // namespace kaamos::effects
