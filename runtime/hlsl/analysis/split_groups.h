// SPDX-License-Identifier: MIT
//
// Compute shaders on a CPU: if all threads of a group reach the body's barriers together, the body
// is cut at them, and each piece runs for one thread after another. What a variable holds across
// pieces is kept per thread. Bodies that cannot be cut run with one fiber per thread.
//
// Straight-line code can be cut, and so can loops and ifs around barriers if their conditions are
// uniform: the same for all threads of the group. Functions that contain barriers are inlined.
//
// The result is the same as with fibers wherever D3D defines one: statements change their order
// among threads only if a barrier separates them or none is needed.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

enum class RegionKind : uint8_t {
  kThreads,   // statements that run for each thread
  kOnce,      // stmt declares or assigns a uniform variable, so it runs once for the group
  kBarrier,   // stmt
  kIf,        // stmt.value; body, orelse
  kLoop,      // stmt.value and test_at_end; prelude, body, step
  kBreak,     // of the innermost kLoop
  kContinue,  // the same
  kReturn,    // for the whole group
};

struct Region {
  RegionKind kind = RegionKind::kThreads;
  const ir::Stmt* stmt = nullptr;
  std::vector<const ir::Stmt*> statements;
  std::vector<Region> prelude;
  std::vector<Region> body;
  std::vector<Region> orelse;
  std::vector<Region> step;
  bool may_return = false;  // kThreads: a thread may end here
};

struct GroupPlan {
  std::vector<Region> regions;
  // Held once for the group; SV_GroupID is one of them.
  std::unordered_set<const ir::Variable*> uniform;
  // Held per thread across regions; includes entry parameters that something writes.
  std::unordered_set<const ir::Variable*> kept;
  bool may_return = false;  // some threads may end before others
  // Statements made for inlined functions.
  std::deque<ir::Stmt> statements;
  std::deque<ir::Expr> expressions;
};

// Returns nothing and sets the reason if the entry point cannot be cut at its barriers, or has
// none.
std::optional<GroupPlan> plan_group(const ir::EntryPoint& entry, std::string& reason);

}  // namespace kaamos::hlsl
