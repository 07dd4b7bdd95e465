// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/atomics.h"

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {
namespace {

bool is_in_memory(const ir::Stmt& statement) {
  if (statement.target == ir::AtomicTarget::kPlace) return false;
  return statement.target != ir::AtomicTarget::kTyped ||
         statement.operands[0]->type->resource == ir::ResourceKind::kRWBuffer;
}

}  // namespace

// Anything else than an unsigned integer of that size becomes a signed one.
const Type* Atomics::any_integer(const Type* given, uint32_t bytes) {
  const Scalar is_unsigned = bytes == 8 ? Scalar::kUint64 : Scalar::kUint32;
  const Scalar is_signed = bytes == 8 ? Scalar::kInt64 : Scalar::kInt32;
  const bool keeps = given && given->is_numeric() && given->scalar == is_unsigned;
  return types_.scalar(keeps ? is_unsigned : is_signed);
}

// Converts an argument to the parameter's type, which is unsigned where the operation is the same
// for both, and that to the memory's, which keeps its bits. [DXC: gen_intrin_main.txt]
const ir::Expr* Atomics::operand(const AtomicRule& rule, const Value& argument, const Type* type,
                                 bool is_compared, bool as_bits) {
  if (is_floating(type->scalar)) {
    const ir::Expr* value = lower_.conversions.convert(argument, type, argument.location);
    const ir::Type* bits = types_.scalar(Scalar::kUint32)->ir;
    return value && as_bits ? build_.intrinsic(Intrinsic::asuint, bits, {value}) : value;
  }
  const uint32_t bytes = scalar_bytes(type->scalar, ScalarStorage::kBuffer);
  const bool takes_any = rule.op == ir::AtomicOp::kMin || rule.op == ir::AtomicOp::kMax ||
                         (rule.op == ir::AtomicOp::kExchange && bytes == 8);
  const Type* parameter = takes_any && !is_compared
                              ? any_integer(argument.type, bytes)
                              : types_.scalar(bytes == 8 ? Scalar::kUint64 : Scalar::kUint32);
  const ir::Expr* value = lower_.conversions.convert(argument, parameter, argument.location);
  return value ? lower_.conversions.convert_numeric(value, parameter, type) : nullptr;
}

Value Atomics::emit_atomic(const AtomicRule& rule, ir::Stmt* statement, const Type* type,
                           bool is_method, std::span<Value> arguments, SourceLocation location) {
  size_t index = 0;
  if (scalar_bytes(type->scalar, ScalarStorage::kBuffer) == 8) {
    lower_.body_rules.check_model("a 64-bit atomic operation", location);
  }
  statement->atomic = rule.op;
  // Floats in memory are exchanged as their bits; texels and groupshared places have their type.
  const bool is_float = is_floating(type->scalar) && is_in_memory(*statement);
  const ir::Type* memory_type = is_float ? types_.scalar(Scalar::kUint32)->ir : type->ir;
  if (rule.has_compare) {
    statement->compare = operand(rule, arguments[index], type, true, is_float);
    if (!statement->compare) return error_value();
    ++index;
  }
  statement->value = operand(rule, arguments[index], type, false, is_float);
  if (!statement->value) return error_value();
  ++index;
  at(location);
  if (index == arguments.size()) {
    body_.emit(statement);
    return rvalue(build_.int32(0), types_.void_type());
  }
  Value& original = arguments[index];
  if (!lower_.bit_fields.require_whole_field(original, original.location,
                                             "the original value of an atomic operation")) {
    return error_value();
  }
  if (!lower_.places.require_place(original, original.location,
                                   "the original value of an atomic operation")) {
    return error_value();
  }
  size_t position = body_.block->size();
  lower_.places.freeze(original, &position);
  const ir::Variable* result = body_.empty_temporary(memory_type);
  statement->result = result;
  body_.emit(statement);
  const ir::Expr* before = build_.read(result);
  const Type* given = type;
  if (is_float) {
    before = build_.intrinsic(Intrinsic::asfloat, type->ir, {before});
  } else {
    const uint32_t bytes = scalar_bytes(type->scalar, ScalarStorage::kBuffer);
    given = is_method && bytes == 4 ? types_.scalar(Scalar::kUint32)
                                    : any_integer(original.type, bytes);
    before = lower_.conversions.convert_numeric(before, type, given);
  }
  lower_.places.store(original, lower_.conversions.convert(rvalue(before, given), original.type,
                                                           original.location, true));
  return rvalue(build_.int32(0), types_.void_type());
}

Value Atomics::call_interlocked(const AtomicRule& rule, std::vector<Value>& arguments,
                                SourceLocation location) {
  const size_t lowest = 2 + (rule.has_compare ? 1 : 0) + (rule.needs_result ? 1 : 0);
  const size_t highest = 2 + (rule.has_compare ? 1 : 0) + (rule.has_result ? 1 : 0);
  if (!lower_.intrinsics.check_count(rule.name, arguments.size(), lowest, highest, location))
    return error_value();
  Value target = arguments[0];
  if (!lower_.bit_fields.require_whole_field(target, target.location,
                                             "the target of an atomic operation") ||
      !lower_.places.require_place(target, target.location, "the target of an atomic operation")) {
    return error_value();
  }
  const Type* type = target.type;
  const bool integer = type->is_scalar() && is_integer(type->scalar) &&
                       scalar_bytes(type->scalar, ScalarStorage::kBuffer) >= 4;
  const bool exchanges_float = type->is_scalar() &&
                               plain_scalar(type->scalar) == Scalar::kFloat32 &&
                               (rule.on_floats || rule.op == ir::AtomicOp::kExchange);
  if (rule.on_floats ? !exchanges_float : !integer && !exchanges_float) {
    report(CheckId::kAtomicType, target.location, {std::string(rule.name), to_string(type)});
    return error_value();
  }
  if (exchanges_float && rule.has_compare && target.kind == ValueKind::kTyped &&
      target.expr->type->resource != ir::ResourceKind::kRWBuffer) {
    report(CheckId::kUnsupported, target.location,
           {"'" + std::string(rule.name) + "' on a texel of a texture"});
    return error_value();
  }
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kAtomic);
  if (target.kind == ValueKind::kTyped && !target.whole) {
    statement->target = ir::AtomicTarget::kTyped;
    statement->operands = {target.expr, target.coordinates};
  } else if (target.kind == ValueKind::kMemory) {
    const ir::Expr* offset =
        target.whole
            ? build_.add(target.offset, lower_.places.component_bytes(target, target.components[0]))
            : target.offset;
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
  return emit_atomic(rule, statement, type, false, std::span(arguments).subspan(1), location);
}

}  // namespace kaamos::hlsl
