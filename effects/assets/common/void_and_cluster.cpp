// SPDX-License-Identifier: MIT
#include "effects/assets/common/void_and_cluster.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "effects/assets/common/sampling.h"

namespace kaamos::effects {
namespace {

/// The cells that are set, and how crowded the surroundings of each cell are. The extremes of each
/// row are cached, because a change touches few rows and nearly all time goes into finding the
/// extreme cell.
class Pattern {
 public:
  explicit Pattern(std::uint32_t size)
      : size_(size), set_(size * size, 0), energy_(size * size, 0), rows_(size) {
    const int reach = kReach;
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x)
        kernel_.push_back(static_cast<std::uint32_t>(
            std::lround(std::exp(-(x * x + y * y) / (2.0 * kSigma * kSigma)) * 1048576.0)));
    for (std::uint32_t y = 0; y < size_; ++y) rescan(y);
  }

  bool is_set(std::uint32_t cell) const { return set_[cell] != 0; }
  void set(std::uint32_t cell, bool value) {
    set_[cell] = value;
    change(cell, value);
  }
  /// The most crowded of the set cells.
  std::uint32_t tightest_cluster() const { return extreme(&Row::cluster, true); }
  /// The least crowded of the cells that are not set.
  std::uint32_t largest_void() const { return extreme(&Row::empty, false); }

 private:
  // Ulichney's advice for the Gaussian. Beyond a reach of 9 it is below 2^-20.
  static constexpr double kSigma = 1.9;
  static constexpr int kReach = 9;
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  struct Row {
    std::uint32_t cluster = kNone;
    std::uint32_t empty = kNone;
  };

  /// Ties of equal energy are broken by a hash of the cell; taking the first would leave a pattern
  /// of rows.
  static std::uint32_t tie(std::uint32_t cell) { return pcg_hash(cell); }
  bool before(std::uint32_t a, std::uint32_t b, bool crowded) const {
    if (energy_[a] != energy_[b]) return (energy_[a] > energy_[b]) == crowded;
    return tie(a) < tie(b);
  }

  void rescan(std::uint32_t y) {
    Row& row = rows_[y];
    row = Row{};
    for (std::uint32_t cell = y * size_; cell < (y + 1) * size_; ++cell) {
      std::uint32_t& best = set_[cell] ? row.cluster : row.empty;
      if (best == kNone || before(cell, best, set_[cell] != 0)) best = cell;
    }
  }

  void change(std::uint32_t cell, bool add) {
    const std::uint32_t mask = size_ - 1;
    const std::uint32_t cx = cell & mask, cy = cell / size_;
    std::size_t k = 0;
    for (int dy = -kReach; dy <= kReach; ++dy) {
      const std::uint32_t row = (cy + static_cast<std::uint32_t>(dy)) & mask;
      for (int dx = -kReach; dx <= kReach; ++dx, ++k) {
        const std::uint32_t column = (cx + static_cast<std::uint32_t>(dx)) & mask;
        std::uint64_t& e = energy_[row * size_ + column];
        e = add ? e + kernel_[k] : e - kernel_[k];
      }
    }
    // A small tile wraps around more than once; scanning a row twice does no harm.
    for (int dy = -kReach; dy <= kReach; ++dy) rescan((cy + static_cast<std::uint32_t>(dy)) & mask);
  }

  std::uint32_t extreme(std::uint32_t Row::*which, bool crowded) const {
    std::uint32_t best = kNone;
    for (const Row& row : rows_)
      if (row.*which != kNone && (best == kNone || before(row.*which, best, crowded)))
        best = row.*which;
    return best;
  }

  std::uint32_t size_;
  std::vector<std::uint8_t> set_;
  std::vector<std::uint64_t> energy_;
  std::vector<std::uint32_t> kernel_;
  std::vector<Row> rows_;
};

/// Sets a tenth of the cells at random, then moves the tightest cluster into the largest void until
/// that changes nothing.
void seed_pattern(Pattern& pattern, std::uint32_t cells, std::uint32_t seed) {
  std::vector<std::uint32_t> order(cells);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t ha = hash_combine(seed, a), hb = hash_combine(seed, b);
    return ha != hb ? ha < hb : a < b;
  });
  for (std::uint32_t i = 0; i < cells / 10; ++i) pattern.set(order[i], true);
  // Ends when a cell returns to its place. The bound only makes that obvious; it is never reached.
  for (std::uint32_t step = 0; step < 16 * cells; ++step) {
    const std::uint32_t from = pattern.tightest_cluster();
    pattern.set(from, false);
    const std::uint32_t to = pattern.largest_void();
    pattern.set(to, true);
    if (to == from) break;
  }
}

}  // namespace

std::vector<std::uint32_t> void_and_cluster(std::uint32_t size, std::uint32_t seed) {
  assert(size >= 8 && size <= 256 && (size & (size - 1)) == 0);
  const std::uint32_t cells = size * size;
  Pattern pattern(size);
  seed_pattern(pattern, cells, seed);
  std::vector<std::uint32_t> rank(cells, 0);
  std::uint32_t ones = 0;
  for (std::uint32_t cell = 0; cell < cells; ++cell) ones += pattern.is_set(cell) ? 1 : 0;

  Pattern shrinking = pattern;
  for (std::uint32_t r = ones; r-- > 0;) {
    const std::uint32_t cell = shrinking.tightest_cluster();
    shrinking.set(cell, false);
    rank[cell] = r;
  }
  // Ulichney's third phase (the other half, with the roles exchanged) would pick the same cells:
  // since the sum of all kernels is constant, the least crowded empty cell is the tightest cluster
  // of empty cells.
  for (std::uint32_t r = ones; r < cells; ++r) {
    const std::uint32_t cell = pattern.largest_void();
    pattern.set(cell, true);
    rank[cell] = r;
  }
  return rank;
}

}  // namespace kaamos::effects
