// SPDX-License-Identifier: MIT
#include "runtime/hlsl/analysis/read_attributes.h"

#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {
namespace {

using namespace ir;

// A parameter that is only handed on to functions that do not read it is not read. There is no
// recursion in HLSL.
bool reads(const Function& function, const Variable* parameter) {
  uint32_t mentions = 0;
  uint32_t handed_on = 0;
  bool read_by_callee = false;
  const auto is_parameter = [&](const Expr& expr) {
    return expr.kind == ExprKind::kVariable && expr.variable == parameter;
  };
  visit(
      function.body, [&](const Expr& expr) { mentions += is_parameter(expr) ? 1 : 0; },
      [&](const Stmt& stmt) {
        if (stmt.kind != StmtKind::kCall) return;
        for (size_t i = 0; i < stmt.arguments.size(); ++i) {
          if (!is_parameter(*stmt.arguments[i])) continue;
          ++handed_on;
          const Variable* received = stmt.function->parameters[i];
          read_by_callee |= received->mode != ParameterMode::kIn || reads(*stmt.function, received);
        }
      });
  return read_by_callee || mentions != handed_on;
}

}  // namespace

bool reads_attributes(const EntryPoint& entry) {
  for (size_t i = 0; i < entry.parameters.size(); ++i) {
    if (entry.parameters[i] != EntryParameter::kAttributes) continue;
    if (reads(*entry.function, entry.function->parameters[i])) return true;
  }
  return false;
}

}  // namespace kaamos::hlsl
