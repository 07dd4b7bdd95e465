// SPDX-License-Identifier: MIT
//
// Which values are the same for all threads of a group. Conservative: what is not known to be is
// not uniform.
#pragma once

#include <unordered_set>

#include "runtime/hlsl/analysis/split_groups.h"

namespace kaamos::hlsl {

class UniformValues {
 public:
  // The regions say which statements all threads run together: a variable is uniform if these
  // alone write it, and uniform values only.
  UniformValues(const ir::EntryPoint& entry, const std::vector<Region>& regions);

  bool holds(const ir::Expr* expr) const;
  // The uniform variables that the expression depends on, by what was assigned to them as well.
  void collect(const ir::Expr* expr, std::unordered_set<const ir::Variable*>& out) const;

 private:
  struct Write {
    const ir::Variable* variable;
    const ir::Expr* value;  // null: zero
  };
  void read_regions(const std::vector<Region>& regions);
  void read_common(const ir::Stmt& stmt);

  std::unordered_set<const ir::Variable*> parameters_;  // of the entry point
  std::unordered_set<const ir::Variable*> variables_;   // the uniform ones
  std::vector<Write> writes_;
};

}  // namespace kaamos::hlsl
