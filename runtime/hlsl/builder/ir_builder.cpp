// SPDX-License-Identifier: MIT
#include "runtime/hlsl/builder/ir_builder.h"

#include "runtime/hlsl/builder/constants.h"

namespace kaamos::hlsl {

ir::Expr* IrBuilder::expr(ir::ExprKind kind, const ir::Type* type,
                          std::initializer_list<const ir::Expr*> operands) {
  ir::Expr* node = &module_.expr_pool.emplace_back();
  node->kind = kind;
  node->type = type;
  node->location = location;
  node->operands = operands;
  return node;
}

ir::Stmt* IrBuilder::stmt(ir::StmtKind kind) {
  ir::Stmt* node = &module_.stmt_pool.emplace_back();
  node->kind = kind;
  node->location = location;
  return node;
}

ir::Variable* IrBuilder::variable(std::string name, const ir::Type* type, ir::Storage storage) {
  ir::Variable* node = &module_.variable_pool.emplace_back();
  node->name = std::move(name);
  node->type = type;
  node->storage = storage;
  node->location = location;
  node->id = next_variable_++;
  return node;
}

const ir::Expr* IrBuilder::fold(const ir::Expr* expression) {
  if (expression->type->kind != ir::TypeKind::kScalar &&
      expression->type->kind != ir::TypeKind::kVector) {
    return expression;
  }
  for (const ir::Expr* operand : expression->operands) {
    if (operand->kind != ir::ExprKind::kLiteral && operand->kind != ir::ExprKind::kZero) {
      return expression;
    }
  }
  auto values = evaluate(expression);
  return values ? literal(expression->type, std::move(*values)) : expression;
}

const ir::Expr* IrBuilder::literal(const ir::Type* type, std::vector<uint64_t> values) {
  ir::Expr* node = expr(ir::ExprKind::kLiteral, type);
  node->literal = std::move(values);
  return node;
}

const ir::Expr* IrBuilder::uint32(uint64_t value) {
  return literal(scalar_type(Scalar::kUint32), {static_cast<uint32_t>(value)});
}

const ir::Expr* IrBuilder::int32(int64_t value) {
  return literal(scalar_type(Scalar::kInt32),
                 {static_cast<uint64_t>(int64_t{static_cast<int32_t>(value)})});
}

const ir::Expr* IrBuilder::boolean(bool value) {
  return literal(scalar_type(Scalar::kBool), {value});
}

const ir::Expr* IrBuilder::zero(const ir::Type* type) {
  if (type->kind == ir::TypeKind::kScalar || type->kind == ir::TypeKind::kVector) {
    const bool is_float = type->scalar >= Scalar::kFloat16;
    const size_t count = type->kind == ir::TypeKind::kScalar ? 1 : type->columns;
    return literal(type, std::vector<uint64_t>(count, is_float ? float_bits(0) : 0));
  }
  return expr(ir::ExprKind::kZero, type);
}

const ir::Expr* IrBuilder::read(const ir::Variable* variable) {
  ir::Expr* node = expr(ir::ExprKind::kVariable, variable->type);
  node->variable = variable;
  return node;
}

const ir::Expr* IrBuilder::field(const ir::Expr* base, uint32_t index) {
  if (base->kind == ir::ExprKind::kConstruct) return base->operands[index];
  const ir::Type* type = base->type->structure->fields[index].type;
  if (base->kind == ir::ExprKind::kZero) return zero(type);
  ir::Expr* node = expr(ir::ExprKind::kField, type, {base});
  node->index = index;
  return node;
}

const ir::Expr* IrBuilder::element(const ir::Expr* base, const ir::Expr* index) {
  const ir::Type* type = base->type;
  const ir::Type* result = type->kind == ir::TypeKind::kArray ? type->element
                           : type->kind == ir::TypeKind::kMatrix
                               ? vector_type(type->scalar, type->columns)
                               : scalar_type(type->scalar);
  if (type->kind == ir::TypeKind::kVector && !type->is_long_vector() &&
      index->kind == ir::ExprKind::kLiteral && index->literal[0] < type->columns) {
    return swizzle(base, {static_cast<uint8_t>(index->literal[0])});
  }
  return fold(expr(ir::ExprKind::kElement, result, {base, index}));
}

const ir::Expr* IrBuilder::swizzle(const ir::Expr* base, std::vector<uint8_t> components) {
  if (base->kind == ir::ExprKind::kSwizzle) {
    for (uint8_t& component : components) component = base->components[component];
    base = base->operands[0];
  } else if (base->kind == ir::ExprKind::kMatrixSwizzle) {
    for (uint8_t& component : components) component = base->components[component];
    return matrix_swizzle(base->operands[0], std::move(components));
  }
  if (base->type->kind == ir::TypeKind::kScalar) {
    if (components.size() == 1) return base;
    return splat(base, vector_type(base->type->scalar, components.size()));
  }
  bool identity = components.size() == base->type->columns;
  for (size_t i = 0; i < components.size(); ++i) identity = identity && components[i] == i;
  if (identity) return base;
  const ir::Type* type = components.size() == 1
                             ? scalar_type(base->type->scalar)
                             : vector_type(base->type->scalar, components.size());
  ir::Expr* node = expr(ir::ExprKind::kSwizzle, type, {base});
  node->components = std::move(components);
  return fold(node);
}

const ir::Expr* IrBuilder::matrix_swizzle(const ir::Expr* base, std::vector<uint8_t> components) {
  const ir::Type* type = components.size() == 1
                             ? scalar_type(base->type->scalar)
                             : vector_type(base->type->scalar, components.size());
  ir::Expr* node = expr(ir::ExprKind::kMatrixSwizzle, type, {base});
  node->components = std::move(components);
  return node;
}

const ir::Expr* IrBuilder::convert(const ir::Expr* operand, Scalar scalar) {
  if (operand->type->scalar == scalar) return operand;
  return fold(expr(ir::ExprKind::kConvert, types_.with_scalar(operand->type, scalar), {operand}));
}

const ir::Expr* IrBuilder::splat(const ir::Expr* operand, const ir::Type* type) {
  if (operand->type == type) return operand;
  return fold(expr(ir::ExprKind::kSplat, type, {operand}));
}

const ir::Expr* IrBuilder::truncate(const ir::Expr* operand, const ir::Type* type) {
  if (operand->type == type) return operand;
  return fold(expr(ir::ExprKind::kTruncate, type, {operand}));
}

const ir::Expr* IrBuilder::construct(const ir::Type* type, std::vector<const ir::Expr*> parts) {
  if (type->kind == ir::TypeKind::kScalar && parts.size() == 1) return parts[0];
  ir::Expr* node = expr(ir::ExprKind::kConstruct, type);
  node->operands = std::move(parts);
  return fold(node);
}

const ir::Expr* IrBuilder::unary(ir::UnaryOp op, const ir::Expr* operand) {
  ir::Expr* node = expr(ir::ExprKind::kUnary, operand->type, {operand});
  node->unary = op;
  return fold(node);
}

const ir::Expr* IrBuilder::binary(ir::BinaryOp op, const ir::Expr* left, const ir::Expr* right) {
  const ir::Type* type =
      op >= ir::BinaryOp::kLess ? types_.with_scalar(left->type, Scalar::kBool) : left->type;
  ir::Expr* node = expr(ir::ExprKind::kBinary, type, {left, right});
  node->binary = op;
  return fold(node);
}

const ir::Expr* IrBuilder::conditional(const ir::Expr* condition, const ir::Expr* yes,
                                       const ir::Expr* no) {
  if (condition->kind == ir::ExprKind::kLiteral) return condition->literal[0] ? yes : no;
  return expr(ir::ExprKind::kConditional, yes->type, {condition, yes, no});
}

const ir::Expr* IrBuilder::intrinsic(Intrinsic which, const ir::Type* type,
                                     std::vector<const ir::Expr*> operands) {
  ir::Expr* node = expr(ir::ExprKind::kIntrinsic, type);
  node->intrinsic = which;
  node->operands = std::move(operands);
  return node;
}

const ir::Expr* IrBuilder::add(const ir::Expr* base, uint32_t constant) {
  if (constant == 0) return base;
  if (base->kind == ir::ExprKind::kBinary && base->binary == ir::BinaryOp::kAdd &&
      base->operands[1]->kind == ir::ExprKind::kLiteral) {
    return binary(ir::BinaryOp::kAdd, base->operands[0],
                  uint32(base->operands[1]->literal[0] + constant));
  }
  return binary(ir::BinaryOp::kAdd, base, uint32(constant));
}

const ir::Expr* IrBuilder::add_scaled(const ir::Expr* base, const ir::Expr* index, uint32_t scale) {
  const ir::Expr* scaled = convert(index, Scalar::kUint32);
  if (scale != 1) scaled = binary(ir::BinaryOp::kMultiply, scaled, uint32(scale));
  if (scaled->kind == ir::ExprKind::kLiteral) {
    return add(base, static_cast<uint32_t>(scaled->literal[0]));
  }
  if (base->kind == ir::ExprKind::kLiteral) {
    return add(scaled, static_cast<uint32_t>(base->literal[0]));
  }
  return binary(ir::BinaryOp::kAdd, base, scaled);
}

ir::Function* make_wrapper(ir::Module& module, IrBuilder& build, const ir::Function& wrapped) {
  ir::Function* wrapper = &module.function_pool.emplace_back();
  wrapper->name = wrapped.name;
  wrapper->result = build.types().void_type();
  wrapper->location = wrapped.location;
  wrapper->end_location = wrapped.end_location;
  return wrapper;
}

}  // namespace kaamos::hlsl
