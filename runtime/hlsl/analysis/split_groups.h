// SPDX-License-Identifier: MIT
//
// Compute shaders on a CPU: a body whose barriers all threads of a group reach together is cut at
// them, and each piece runs for one thread after the other. What a variable holds across pieces is
// kept for each thread. Bodies that cannot be cut run with a fiber for each thread.
//
// Cut are straight lines of statements, and loops and ifs around barriers whose conditions are
// uniform: the same for all threads of the group. Functions that hold barriers are put in place of
// their calls.
//
// The result is that of fibers wherever D3D defines one: only statements between which a barrier
// stands, or none is needed, change their order among threads.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

enum class RegionKind : uint8_t {
  kThreads,   // statements, run for each thread
  kOnce,      // stmt declares or assigns a uniform variable: run once for the group
  kBarrier,   // stmt
  kIf,        // stmt.value; body, orelse
  kLoop,      // stmt.value and test_at_end; prelude, body, step
  kBreak,     // of the innermost kLoop
  kContinue,  // the same
  kReturn,    // of the whole group
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
  // One for the group; SV_GroupID among them.
  std::unordered_set<const ir::Variable*> uniform;
  // One for each thread, across regions; entry parameters if something writes them.
  std::unordered_set<const ir::Variable*> kept;
  bool may_return = false;  // some thread may end before the others
  // Made for functions that were put in place of their calls.
  std::deque<ir::Stmt> statements;
  std::deque<ir::Expr> expressions;
};

// Nothing, with the reason, where the entry point's barriers cannot be cut at. Without barriers
// there is nothing to cut either.
std::optional<GroupPlan> plan_group(const ir::EntryPoint& entry, std::string& reason);

}  // namespace kaamos::hlsl
