// SPDX-License-Identifier: MIT
#include "effects/assets/image/pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kaamos::effects {

namespace {

bool is_finite(const Trade& trade) {
  return std::isfinite(trade.cost) && std::isfinite(trade.error);
}

}  // namespace

std::vector<std::size_t> pareto_front(const std::vector<Trade>& trades) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < trades.size(); ++i) {
    if (is_finite(trades[i])) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (trades[a].cost != trades[b].cost) return trades[a].cost < trades[b].cost;
    return trades[a].error < trades[b].error;
  });
  std::vector<std::size_t> out;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (trades[i].error >= least) continue;
    least = trades[i].error;
    out.push_back(i);
  }
  return out;
}

std::size_t cheapest_within(const std::vector<Trade>& trades, double error) {
  std::size_t out = trades.size();
  for (std::size_t i = 0; i < trades.size(); ++i) {
    if (!is_finite(trades[i]) || trades[i].error > error) continue;
    if (out == trades.size() || trades[i].cost < trades[out].cost) out = i;
  }
  return out;
}

}  // namespace kaamos::effects
