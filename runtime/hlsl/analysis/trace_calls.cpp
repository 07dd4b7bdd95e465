// SPDX-License-Identifier: MIT
#include "runtime/hlsl/analysis/trace_calls.h"

#include <algorithm>
#include <map>
#include <optional>

#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {
namespace {

using namespace ir;
using Value = std::optional<uint32_t>;

// Calls are followed with their constant arguments; beyond this many, the remaining ones count as
// unknown.
constexpr uint32_t kMostCalls = 4096;

class Walk {
 public:
  explicit Walk(const Module& module) : module_(module) {}

  void enter(const Function& function, std::map<const Variable*, Value> known) {
    if (!function.may_trace && !function.may_call) return;
    if (++calls_ > kMostCalls) known.clear();
    if (calls_ > 2 * kMostCalls) return;
    forget_written(function, known);
    const auto nothing = [](const Expr&) {};
    visit(function.body, nothing, [&](const Stmt& stmt) {
      switch (stmt.kind) {
        case StmtKind::kDeclare:
          // Variables that are written again later are not in the map.
          if (const auto it = known.find(stmt.variable); it != known.end()) {
            it->second = stmt.value != nullptr ? evaluate(*stmt.value, known) : Value(0);
          }
          break;
        case StmtKind::kTraceRay:
          add(stmt, known);
          break;
        case StmtKind::kCallShader:
          add_callable(evaluate(*stmt.operands[0], known).value_or(shader::kUnknownIndex));
          break;
        case StmtKind::kCall:
          follow(stmt, known);
          break;
        default:
          break;
      }
    });
  }

  ReachedCalls found;

 private:
  static bool is_number(const Type* type) {
    return type != nullptr && type->kind == TypeKind::kScalar &&
           (type->scalar == Scalar::kUint32 || type->scalar == Scalar::kInt32);
  }

  // Keeps only variables with a single value: parameters that are never written, and locals that
  // only their declaration writes.
  void forget_written(const Function& function, std::map<const Variable*, Value>& known) {
    std::map<const Variable*, uint32_t> writes;
    const auto nothing = [](const Expr&) {};
    visit(function.body, nothing, [&](const Stmt& stmt) {
      visit_written(stmt, [&](const Variable* variable, const Expr*) { ++writes[variable]; });
      if (stmt.kind == StmtKind::kDeclare && is_number(stmt.variable->type)) {
        known[stmt.variable] = std::nullopt;
      }
    });
    for (const auto& [variable, count] : writes) {
      if (variable == nullptr) continue;
      if (count > (variable->storage == Storage::kLocal ? 1u : 0u)) known.erase(variable);
    }
  }

  Value evaluate(const Expr& expr, const std::map<const Variable*, Value>& known) const {
    if (!is_number(expr.type)) return std::nullopt;
    switch (expr.kind) {
      case ExprKind::kZero:
        return 0;
      case ExprKind::kLiteral:
        return static_cast<uint32_t>(expr.literal[0]);
      case ExprKind::kConvert:
        return evaluate(*expr.operands[0], known);
      case ExprKind::kVariable: {
        if (expr.variable->storage == Storage::kConstant) {
          return expr.variable->initialiser != nullptr
                     ? evaluate(*expr.variable->initialiser, known)
                     : Value(0);
        }
        const auto it = known.find(expr.variable);
        return it == known.end() ? std::nullopt : it->second;
      }
      case ExprKind::kBinary: {
        const Value a = evaluate(*expr.operands[0], known);
        const Value b = evaluate(*expr.operands[1], known);
        if (!a || !b) return std::nullopt;
        return combine(expr.binary, *a, *b);
      }
      default:
        return std::nullopt;
    }
  }

  static Value combine(BinaryOp op, uint32_t a, uint32_t b) {
    switch (op) {
      case BinaryOp::kAdd:
        return a + b;
      case BinaryOp::kSubtract:
        return a - b;
      case BinaryOp::kMultiply:
        return a * b;
      case BinaryOp::kBitAnd:
        return a & b;
      case BinaryOp::kBitOr:
        return a | b;
      case BinaryOp::kShiftLeft:
        return a << (b & 31);
      default:
        return std::nullopt;
    }
  }

  void add(const Stmt& stmt, const std::map<const Variable*, Value>& known) {
    shader::TraceCall call = {};
    const Expr& scene = *stmt.operands[0];
    const bool direct = scene.kind == ExprKind::kBinding && scene.operands.empty();
    call.binding = direct ? scene.index : shader::kUnknownIndex;
    call.line = stmt.location.line;
    call.file = "";
    if (stmt.location.file < module_.files.size()) {
      call.file = module_.files[stmt.location.file].c_str();
    }
    uint32_t* const fields[] = {&call.ray_flags, &call.mask, &call.ray_contribution,
                                &call.multiplier, &call.miss_index};
    constexpr uint32_t kSignificant[] = {0xFFFFFFFFu, 0xFF, 0xF, 0xF, 0xFFFF};
    for (uint32_t i = 0; i < 5; ++i) {
      const Value value = evaluate(*stmt.operands[i + 1], known);
      if (!value) continue;
      *fields[i] = *value & kSignificant[i];
      call.known |= 1u << i;
    }
    const auto same = [&](const shader::TraceCall& other) {
      return other.binding == call.binding && other.known == call.known &&
             other.line == call.line && other.ray_flags == call.ray_flags &&
             other.mask == call.mask && other.ray_contribution == call.ray_contribution &&
             other.multiplier == call.multiplier && other.miss_index == call.miss_index;
    };
    if (std::none_of(found.traces.begin(), found.traces.end(), same)) found.traces.push_back(call);
  }

  void add_callable(uint32_t index) {
    auto& list = found.callables;
    if (std::find(list.begin(), list.end(), index) == list.end()) list.push_back(index);
  }

  void follow(const Stmt& stmt, const std::map<const Variable*, Value>& known) {
    std::map<const Variable*, Value> inner;
    for (size_t i = 0; i < stmt.arguments.size(); ++i) {
      const Variable* parameter = stmt.function->parameters[i];
      if (parameter->mode != ParameterMode::kIn || !is_number(parameter->type)) continue;
      inner[parameter] = evaluate(*stmt.arguments[i], known);
    }
    enter(*stmt.function, std::move(inner));
  }

  const Module& module_;
  uint32_t calls_ = 0;
};

bool is_constant(const Expr& expr) {
  switch (expr.kind) {
    case ExprKind::kZero:
    case ExprKind::kLiteral:
      return true;
    case ExprKind::kConvert:
      return is_constant(*expr.operands[0]);
    case ExprKind::kVariable:
      return expr.variable->storage == Storage::kConstant;
    case ExprKind::kBinary:
      return is_constant(*expr.operands[0]) && is_constant(*expr.operands[1]);
    default:
      return false;
  }
}

}  // namespace

bool is_unknown(const Module& module, const Stmt& call) {
  if (call.kind == StmtKind::kCallShader) return !is_constant(*call.operands[0]);
  const Expr& scene = *call.operands[0];
  const bool direct = scene.kind == ExprKind::kBinding && !module.bindings[scene.index].is_array;
  if (!direct) return true;
  // A RayQuery reaches no shader records.
  if (call.kind == StmtKind::kQuery) return false;
  for (size_t i = 1; i <= 5; ++i) {
    if (!is_constant(*call.operands[i])) return true;
  }
  return false;
}

ReachedCalls collect_calls(const Module& module, const EntryPoint& entry) {
  Walk walk(module);
  walk.enter(*entry.function, {});
  return std::move(walk.found);
}

}  // namespace kaamos::hlsl
