// SPDX-License-Identifier: MIT
// Interlocked operations on groupshared memory, buffers and texels.
#include "runtime/hlsl/check/checker.h"

namespace kaamos::hlsl {

Value Lowerer::emit_atomic(const AtomicRule& rule, ir::Stmt* statement, const Type* type,
                           std::span<Value> arguments, SourceLocation location) {
  size_t index = 0;
  statement->atomic = rule.op;
  if (rule.has_compare) {
    statement->compare = convert(arguments[index], type, arguments[index].location);
    if (!statement->compare) return error_value();
    ++index;
  }
  statement->value = convert(arguments[index], type, arguments[index].location);
  if (!statement->value) return error_value();
  ++index;
  at(location);
  if (index == arguments.size()) {
    emit(statement);
    return rvalue(build_.int32(0), types_.void_type());
  }
  Value& original = arguments[index];
  if (!require_whole_field(original, original.location,
                           "the original value of an atomic operation")) {
    return error_value();
  }
  if (!require_place(original, original.location, "the original value of an atomic operation")) {
    return error_value();
  }
  size_t position = block().size();
  freeze(original, &position);
  const ir::Variable* result = empty_temporary(type->ir);
  statement->result = result;
  emit(statement);
  store(original,
        convert(rvalue(build_.read(result), type), original.type, original.location, true));
  return rvalue(build_.int32(0), types_.void_type());
}

Value Lowerer::call_interlocked(const AtomicRule& rule, std::vector<Value>& arguments,
                                SourceLocation location) {
  const size_t lowest = 2 + (rule.has_compare ? 1 : 0) + (rule.needs_result ? 1 : 0);
  const size_t highest = 2 + (rule.has_compare ? 1 : 0) + (rule.has_result ? 1 : 0);
  if (!check_count(rule.name, arguments.size(), lowest, highest, location)) return error_value();
  Value target = arguments[0];
  if (!require_whole_field(target, target.location, "the target of an atomic operation") ||
      !require_place(target, target.location, "the target of an atomic operation")) {
    return error_value();
  }
  const Type* type = target.type;
  const bool integer =
      type->is_scalar() && is_integer(type->scalar) && scalar_bytes(type->scalar) >= 4;
  if (!integer) {
    report(CheckId::kAtomicType, target.location, {std::string(rule.name), to_string(type)});
    return error_value();
  }
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kAtomic);
  if (target.kind == ValueKind::kTyped && !target.whole) {
    statement->target = ir::AtomicTarget::kTyped;
    statement->operands = {target.expr, target.coordinates};
  } else if (target.kind == ValueKind::kMemory &&
             (!target.whole || (!target.whole->is_matrix() && !target.component_stride))) {
    const uint32_t bytes = scalar_bytes(type->scalar);
    const ir::Expr* offset =
        target.whole ? build_.add(target.offset, target.components[0] * bytes) : target.offset;
    if (target.element) {
      statement->target = ir::AtomicTarget::kElement;
      statement->operands = {target.expr, target.element, offset};
    } else {
      statement->target = ir::AtomicTarget::kMemory;
      statement->operands = {target.expr, offset};
    }
  } else {
    const ir::Expr* root = target.kind == ValueKind::kExpr ? target.expr : nullptr;
    while (root && root->kind != ir::ExprKind::kVariable) {
      root = root->operands.empty() ? nullptr : root->operands[0];
    }
    if (!root || root->variable->storage != ir::Storage::kGroupShared) {
      report(CheckId::kAtomicTarget, target.location, {std::string(rule.name)});
      return error_value();
    }
    statement->target = ir::AtomicTarget::kPlace;
    statement->place = target.expr;
  }
  return emit_atomic(rule, statement, type, std::span(arguments).subspan(1), location);
}

}  // namespace kaamos::hlsl
