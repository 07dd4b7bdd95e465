// SPDX-License-Identifier: MIT
//
// Finds which lanes take part in a wave operation on a CPU, where every lane, or every eight of
// them, runs on its own fiber: those that would be active on a machine whose lanes run in lockstep
// and join again where statements end. [HLSL: Wave intrinsics, active lanes]
//
// A lane that comes to an operation waits there with its path, the words that say where it is: the
// number of the statement in its function, for a loop followed by the number of the iteration, and
// then the same inside of the loop or of the called function. Statements are numbered in the order
// in which they run. Once every lane of a wave waits or has ended, those with the lexicographically
// least path go on, together: all others are behind them in the program, in a later iteration or on
// the other side of a condition, and would wait there for them to join. Equal paths mean that lanes
// are at the same operation, in the same iteration of every loop, called from the same places.
//
// So `if (a) x(); else y(); z();` runs x for those lanes that have a, then y for the others, and z
// for all. A lane that continues its loop or leaves it waits for the others at the next operation
// that they share, if there is one.
#pragma once

#include <cstdint>
#include <unordered_map>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// A wave operation, or a loop or call that can reach one.
struct WavePlace {
  uint32_t number = 0;
  uint32_t depth = 0;  // words of the path before the number, counted from the function's start
};

class WavePaths {
 public:
  explicit WavePaths(const ir::Module& module);

  // Null if the statement is in no path.
  const WavePlace* find(const ir::Stmt& stmt) const;
  // The most words of a path that begins in the function; 0: it reaches no operation.
  uint32_t length(const ir::Function& function) const;

 private:
  void walk(const ir::Block& block, uint32_t depth);
  void walk(const ir::Stmt& stmt, uint32_t depth);
  void add(const ir::Stmt& stmt, uint32_t depth, uint32_t words);

  std::unordered_map<const ir::Stmt*, WavePlace> places_;
  std::unordered_map<const ir::Function*, uint32_t> lengths_;
  // The constructor walks one function after another.
  uint32_t next_ = 0;    // number of the function's next place
  uint32_t length_ = 0;  // of its longest path so far
};

// Returns whether the statement or anything in it can reach a wave operation.
bool reaches_wave(const ir::Stmt& stmt);

}  // namespace kaamos::hlsl
