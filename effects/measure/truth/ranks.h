// SPDX-License-Identifier: MIT
// The processes that `mpirun -n N northlight` starts. Built without MPI, or started without mpirun,
// there is one.
#pragma once

#include <cstdint>
#include <span>

namespace kaamos::measure {

// All ranks must make the same calls in the same order. A rank that dies ends all: mpirun names it.
class Ranks {
 public:
  // Joins the others where mpirun started this process. One object for a process.
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  std::uint32_t rank() const { return rank_; }
  std::uint32_t count() const { return count_; }
  bool is_first() const { return rank_ == 0; }

  // Adds up the ranks' values at rank 0; the others' stay.
  void sum_at_first(std::span<double> values) const;
  // Gives rank 0's values to all.
  void copy_from_first(std::span<double> values) const;
  void copy_from_first(std::span<std::uint32_t> values) const;
  // Returns whether the value is true on any rank.
  bool any(bool value) const;

 private:
  std::uint32_t rank_ = 0;
  std::uint32_t count_ = 1;
  bool has_begun_ = false;
};

}  // namespace kaamos::measure
