// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/waves.h"

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {

using shader::WaveOp;

// The type that the first operand is converted to; null after an error.
const Type* Waves::wave_operand_type(const WaveRule& rule, const Value& argument) {
  const Type* type = argument.type;
  const auto refuse = [&](std::string_view wanted) {
    report(
        CheckId::kIntrinsicArgument, argument.location,
        {"1", std::string(rule.name), std::string(wanted), type ? to_string(type) : "a resource"});
    return nullptr;
  };
  if (!type || !type->is_numeric() || (rule.op == WaveOp::kMatch && type->is_matrix())) {
    return refuse("a number or a vector");
  }
  if (rule.operand == WaveOperand::kBool) return types_.boolean();
  if (is_literal(type->scalar)) type = types_.settled(type);
  if (rule.operand != WaveOperand::kAny && type->scalar == Scalar::kBool) {
    type = types_.with_scalar(type, Scalar::kInt32);
  }
  const bool bits = rule.operand == WaveOperand::kInteger || rule.operand == WaveOperand::kUnsigned;
  if (bits && is_floating(type->scalar)) return refuse("an integer");
  if (rule.operand != WaveOperand::kUnsigned) return type;
  switch (type->scalar) {
    case Scalar::kInt16:
      return types_.with_scalar(type, Scalar::kUint16);
    case Scalar::kInt32:
      return types_.with_scalar(type, Scalar::kUint32);
    case Scalar::kInt64:
      return types_.with_scalar(type, Scalar::kUint64);
    default:
      return type;
  }
}

// Emits the operation on a scalar or a vector.
const ir::Expr* Waves::emit_wave(WaveOp op, std::vector<const ir::Expr*> operands,
                                 const Type* type) {
  const ir::Variable* result = body_.empty_temporary(type->ir);
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kWave);
  statement->wave = op;
  statement->operands = std::move(operands);
  statement->result = result;
  body_.emit(statement);
  if (body_.function) body_.function->waves.push_back(statement);
  return build_.read(result);
}

// A matrix goes row by row.
const ir::Expr* Waves::emit_wave_of_rows(WaveOp op, const std::vector<const ir::Expr*>& operands,
                                         const Type* from, const Type* type) {
  const ir::Expr* matrix = build_.read(body_.temporary(operands[0]));
  std::vector<const ir::Expr*> rows;
  for (uint32_t row = 0; row < from->rows; ++row) {
    std::vector<uint8_t> components;
    for (uint32_t column = 0; column < from->columns; ++column) {
      components.push_back(static_cast<uint8_t>(row * 4 + column));
    }
    std::vector<const ir::Expr*> parts = operands;
    parts[0] = build_.matrix_swizzle(matrix, components);
    const Type* part = from->columns == 1 ? types_.scalar(type->scalar)
                                          : types_.vector(type->scalar, from->columns);
    rows.push_back(emit_wave(op, parts, part));
  }
  return build_.construct(type->ir, rows);
}

std::optional<Value> Waves::call_wave(std::string_view name, std::vector<Value>& arguments,
                                      SourceLocation location) {
  const WaveRule* rule = find_wave(name);
  if (!rule) return std::nullopt;
  const bool has_lane = shader::has_lane_operand(rule->op);
  const bool has_mask = shader::has_mask_operand(rule->op);
  const size_t count = rule->operand == WaveOperand::kNone ? 0
                       : has_lane || has_mask              ? size_t{2}
                                                           : size_t{1};
  if (!lower_.intrinsics.check_count(name, arguments.size(), count, count, location))
    return error_value();
  if (rule->minor > shader_model_minor(names_.options().target)) {
    report(CheckId::kWaveShaderModel, location,
           {std::string(name), "6." + std::to_string(rule->minor), names_.options().target});
    return error_value();
  }
  if (shader::is_quad_operation(rule->op)) {
    lower_.intrinsics.use_in_stages(rule->name, ir::kStageCompute | ir::kStagePixel, location);
  }
  if (rule->op == WaveOp::kGroupWaveIndex || rule->op == WaveOp::kGroupWaveCount) {
    lower_.intrinsics.use_in_stages(rule->name, ir::kStageCompute, location);
  }
  const Type* number = types_.scalar(Scalar::kUint32);
  const Type* four = types_.vector(Scalar::kUint32, 4);
  std::vector<const ir::Expr*> operands;
  const Type* type = nullptr;
  if (count > 0) {
    type = wave_operand_type(*rule, arguments[0]);
    if (!type) return error_value();
    operands.push_back(lower_.conversions.convert(arguments[0], type, arguments[0].location));
  }
  if (count > 1) {
    operands.push_back(
        lower_.conversions.convert(arguments[1], has_mask ? four : number, arguments[1].location));
  }
  for (const ir::Expr* operand : operands) {
    if (!operand) return error_value();
  }
  at(location);
  const Type* result = type;
  if (rule->op == WaveOp::kAllEqual) {
    result = types_.with_scalar(type, Scalar::kBool);
  } else if (shader::gives_bool(rule->op)) {
    result = types_.boolean();
  } else if (shader::gives_number(rule->op)) {
    result = number;
  } else if (shader::gives_mask(rule->op)) {
    result = four;
  }
  if (type && type->is_matrix()) {
    return rvalue(emit_wave_of_rows(rule->op, operands, type, result), result);
  }
  return rvalue(emit_wave(rule->op, std::move(operands), result), result);
}

}  // namespace kaamos::hlsl
