// SPDX-License-Identifier: MIT
//
// Finds the values that are the same for all threads of a group. It is conservative: a value that
// is not known to be uniform is not treated as uniform.
#pragma once

#include <unordered_set>

#include "runtime/hlsl/analysis/split_groups.h"

namespace kaamos::hlsl {

class UniformValues {
 public:
  // The regions say which statements all threads run together: a variable is uniform if only those
  // write it, and only with uniform values.
  UniformValues(const ir::EntryPoint& entry, const std::vector<Region>& regions);

  bool holds(const ir::Expr* expr) const;
  // Collects the uniform variables that the expression depends on, directly or through assignments
  // to them.
  void collect(const ir::Expr* expr, std::unordered_set<const ir::Variable*>& out) const;

 private:
  struct Write {
    const ir::Variable* variable;
    const ir::Expr* value;  // null: zero
  };
  void read_regions(const std::vector<Region>& regions);
  void read_common(const ir::Stmt& stmt);

  std::unordered_set<const ir::Variable*> parameters_;  // the entry point's
  std::unordered_set<const ir::Variable*> variables_;   // the uniform ones
  std::vector<Write> writes_;
};

}  // namespace kaamos::hlsl
