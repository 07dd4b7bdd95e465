// SPDX-License-Identifier: MIT
#include "runtime/hlsl/analysis/wave_paths.h"

#include <algorithm>

#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {

using namespace ir;

bool reaches_wave(const Stmt& stmt) {
  bool found = false;
  visit(
      stmt, [](const Expr&) {},
      [&](const Stmt& each) {
        found = found || each.kind == StmtKind::kWave ||
                (each.kind == StmtKind::kCall && each.function->has_waves);
      });
  return found;
}

WavePaths::WavePaths(const Module& module) {
  for (const Function* function : module.functions) {
    if (!function->has_waves) continue;
    next_ = length_ = 0;
    walk(function->body, 0);
    lengths_[function] = length_;
  }
}

const WavePlace* WavePaths::find(const Stmt& stmt) const {
  const auto found = places_.find(&stmt);
  return found == places_.end() ? nullptr : &found->second;
}

uint32_t WavePaths::length(const Function& function) const {
  const auto found = lengths_.find(&function);
  return found == lengths_.end() ? 0 : found->second;
}

void WavePaths::add(const Stmt& stmt, uint32_t depth, uint32_t words) {
  places_[&stmt] = {next_++, depth};
  length_ = std::max(length_, depth + words);
}

void WavePaths::walk(const Block& block, uint32_t depth) {
  for (const Stmt* stmt : block) walk(*stmt, depth);
}

void WavePaths::walk(const Stmt& stmt, uint32_t depth) {
  switch (stmt.kind) {
    case StmtKind::kWave:
      return add(stmt, depth, 1);
    case StmtKind::kCall:
      if (stmt.function->has_waves) add(stmt, depth, 1 + length(*stmt.function));
      return;
    case StmtKind::kLoop:
      if (!reaches_wave(stmt)) return;
      add(stmt, depth, 2);
      if (!stmt.test_at_end) walk(stmt.prelude, depth + 2);
      walk(stmt.body, depth + 2);
      walk(stmt.step, depth + 2);
      if (stmt.test_at_end) walk(stmt.prelude, depth + 2);
      return;
    default:
      walk(stmt.body, depth);
      walk(stmt.orelse, depth);
      for (const SwitchCase& c : stmt.cases) walk(c.body, depth);
      return;
  }
}

}  // namespace kaamos::hlsl
