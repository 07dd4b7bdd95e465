// SPDX-License-Identifier: MIT
//
// Coverage: a statement at each line and in each arm of a branch says that it ran. What is lowered
// more than once, such as a template, has its points once; what a constant condition leaves out has
// none. [kaamos/shader/coverage.h]
#pragma once

#include <cstdint>
#include <map>
#include <tuple>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Coverage : LowerPart {
 public:
  using LowerPart::LowerPart;

  // The line of a statement, or of a function, before its code.
  void statement(const Stmt& statement);
  void line(SourceLocation location);

  // The arms of an if, before they are lowered.
  void arms(ir::Block& then, ir::Block& orelse, SourceLocation location);
  // The sides of ?:, and of && and || the right side and that it is skipped. Both sides of them run
  // before HLSL 2021.
  void sides(ir::Block& first, ir::Block& second, SourceLocation location);
  // Whether a loop takes another turn, after it is lowered.
  void loop(ir::Stmt& node, SourceLocation location);
  // The section of a switch that is lowered next, and what stands for a default that is not there.
  void section(const ir::Stmt& node, SourceLocation location);
  void no_section(ir::Stmt& node, SourceLocation location);

 private:
  using Key = std::tuple<uint32_t, uint32_t, uint32_t, uint32_t>;  // file, line, column, arm

  bool is_on() const;
  // A branch in a macro is not the user's whenever it is used.
  bool has_arms(SourceLocation location) const;
  const ir::Stmt* cover(const ir::CoveragePoint& point);
  const ir::Stmt* arm(SourceLocation location, size_t number);

  std::map<Key, uint32_t> points_;
};

}  // namespace kaamos::hlsl
