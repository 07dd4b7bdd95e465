// SPDX-License-Identifier: MIT
#include "runtime/hlsl/builder/constants.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace kaamos::hlsl {
namespace {

bool is_signed(Scalar scalar) {
  return scalar == Scalar::kInt16 || scalar == Scalar::kInt32 || scalar == Scalar::kInt64;
}

uint32_t width_of(Scalar scalar) {
  switch (scalar) {
    case Scalar::kInt16:
    case Scalar::kUint16:
      return 16;
    case Scalar::kInt64:
    case Scalar::kUint64:
      return 64;
    default:
      return 32;
  }
}

double round_to_half(double value) {
  if (!std::isfinite(value) || value == 0) return value;
  int exponent = 0;
  std::frexp(value, &exponent);
  const double quantum = std::ldexp(1.0, std::max(exponent, -13) - 11);
  const double rounded = std::nearbyint(value / quantum) * quantum;
  return std::fabs(rounded) > 65504.0
             ? std::copysign(std::numeric_limits<double>::infinity(), rounded)
             : rounded;
}

uint64_t saturate_to_integer(double value, Scalar to) {
  if (std::isnan(value)) return 0;
  const uint32_t width = width_of(to);
  if (is_signed(to)) {
    const double limit = std::ldexp(1.0, static_cast<int>(width) - 1);
    const int64_t highest =
        width == 64 ? std::numeric_limits<int64_t>::max() : (int64_t{1} << (width - 1)) - 1;
    if (value >= limit) return static_cast<uint64_t>(highest);
    if (value < -limit) return static_cast<uint64_t>(-highest - 1);
    return static_cast<uint64_t>(static_cast<int64_t>(value));
  }
  const double limit = std::ldexp(1.0, static_cast<int>(width));
  if (value >= limit) {
    return width == 64 ? std::numeric_limits<uint64_t>::max() : (uint64_t{1} << width) - 1;
  }
  return value <= 0 ? 0 : static_cast<uint64_t>(value);
}

template <class T>
bool compare(ir::BinaryOp op, T left, T right) {
  switch (op) {
    case ir::BinaryOp::kLess:
      return left < right;
    case ir::BinaryOp::kLessEqual:
      return left <= right;
    case ir::BinaryOp::kGreater:
      return left > right;
    case ir::BinaryOp::kGreaterEqual:
      return left >= right;
    case ir::BinaryOp::kEqual:
      return left == right;
    default:
      return left != right;
  }
}

bool is_comparison(ir::BinaryOp op) {
  return op >= ir::BinaryOp::kLess;
}

std::optional<double> float_operation(ir::BinaryOp op, double left, double right) {
  switch (op) {
    case ir::BinaryOp::kAdd:
      return left + right;
    case ir::BinaryOp::kSubtract:
      return left - right;
    case ir::BinaryOp::kMultiply:
      return left * right;
    case ir::BinaryOp::kDivide:
      return left / right;
    case ir::BinaryOp::kModulo:
      return std::fmod(left, right);
    default:
      return std::nullopt;
  }
}

std::optional<uint64_t> integer_operation(ir::BinaryOp op, Scalar scalar, uint64_t left,
                                          uint64_t right) {
  const uint32_t shift = static_cast<uint32_t>(right) & (width_of(scalar) - 1);
  switch (op) {
    case ir::BinaryOp::kAdd:
      return left + right;
    case ir::BinaryOp::kSubtract:
      return left - right;
    case ir::BinaryOp::kMultiply:
      return left * right;
    case ir::BinaryOp::kDivide:
    case ir::BinaryOp::kModulo:
      if (right == 0) return std::nullopt;
      if (is_signed(scalar)) {
        if (static_cast<int64_t>(right) == -1) {
          return op == ir::BinaryOp::kDivide ? uint64_t{0} - left : 0;
        }
        const int64_t a = static_cast<int64_t>(left);
        const int64_t b = static_cast<int64_t>(right);
        return static_cast<uint64_t>(op == ir::BinaryOp::kDivide ? a / b : a % b);
      }
      return op == ir::BinaryOp::kDivide ? left / right : left % right;
    case ir::BinaryOp::kBitAnd:
      return left & right;
    case ir::BinaryOp::kBitOr:
      return left | right;
    case ir::BinaryOp::kBitXor:
      return left ^ right;
    case ir::BinaryOp::kShiftLeft:
      return left << shift;
    case ir::BinaryOp::kShiftRight:
      return is_signed(scalar) ? static_cast<uint64_t>(static_cast<int64_t>(left) >> shift)
                               : left >> shift;
    default:
      return std::nullopt;
  }
}

uint32_t component_count(const ir::Type* type) {
  switch (type->kind) {
    case ir::TypeKind::kScalar:
      return 1;
    case ir::TypeKind::kVector:
      return type->columns;
    case ir::TypeKind::kMatrix:
      return uint32_t{type->rows} * type->columns;
    default:
      return 0;
  }
}

// Follows variables, fields and elements to the expression that produces the value.
const ir::Expr* source_of(const ir::Expr* expression, int depth) {
  if (depth > 64 || !expression) return nullptr;
  switch (expression->kind) {
    case ir::ExprKind::kVariable:
      if (expression->variable->storage != ir::Storage::kConstant ||
          !expression->variable->initialiser) {
        return nullptr;
      }
      return source_of(expression->variable->initialiser, depth + 1);
    case ir::ExprKind::kField: {
      const ir::Expr* base = source_of(expression->operands[0], depth + 1);
      if (!base || base->kind != ir::ExprKind::kConstruct ||
          expression->index >= base->operands.size()) {
        return nullptr;
      }
      return source_of(base->operands[expression->index], depth + 1);
    }
    case ir::ExprKind::kElement: {
      if (expression->operands[0]->type->kind != ir::TypeKind::kArray) return expression;
      const ir::Expr* base = source_of(expression->operands[0], depth + 1);
      const auto index = evaluate(expression->operands[1]);
      if (!base || !index || base->kind != ir::ExprKind::kConstruct ||
          (*index)[0] >= base->operands.size()) {
        return nullptr;
      }
      return source_of(base->operands[(*index)[0]], depth + 1);
    }
    default:
      return expression;
  }
}

using Components = std::optional<std::vector<uint64_t>>;
Components evaluate_at(const ir::Expr* expression, int depth);

Components evaluate_pair(const ir::Expr* e, int depth) {
  const Components left = evaluate_at(e->operands[0], depth);
  if (!left) return std::nullopt;
  const Components right = evaluate_at(e->operands[1], depth);
  if (!right || left->size() != right->size()) return std::nullopt;
  std::vector<uint64_t> result;
  for (size_t i = 0; i < left->size(); ++i) {
    const auto value =
        fold_binary(e->binary, e->operands[0]->type->scalar, (*left)[i], (*right)[i]);
    if (!value) return std::nullopt;
    result.push_back(*value);
  }
  return result;
}

Components evaluate_element(const ir::Expr* e, int depth) {
  const Components base = evaluate_at(e->operands[0], depth);
  const Components index = evaluate_at(e->operands[1], depth);
  if (!base || !index) return std::nullopt;
  const ir::Type* type = e->operands[0]->type;
  const size_t size = type->kind == ir::TypeKind::kMatrix ? type->columns : 1;
  const uint64_t first = (*index)[0];
  if (first >= base->size() / size) return std::nullopt;
  return std::vector<uint64_t>(base->begin() + first * size, base->begin() + (first + 1) * size);
}

Components evaluate_truncation(const ir::Expr* e, const std::vector<uint64_t>& base) {
  std::vector<uint64_t> result;
  const ir::Type* from = e->operands[0]->type;
  for (uint32_t row = 0; row < e->type->rows; ++row) {
    for (uint32_t column = 0; column < e->type->columns; ++column) {
      result.push_back(base[row * from->columns + column]);
    }
  }
  return result;
}

Components evaluate_intrinsic(const ir::Expr* e, int depth) {
  std::vector<std::vector<uint64_t>> arguments;
  for (const ir::Expr* operand : e->operands) {
    const Components value = evaluate_at(operand, depth);
    if (!value) return std::nullopt;
    arguments.push_back(*value);
  }
  const Scalar scalar = e->type->scalar;
  std::vector<uint64_t> result;
  for (size_t i = 0; i < component_count(e->type); ++i) {
    const bool is_max = e->intrinsic == Intrinsic::max;
    if (is_max || e->intrinsic == Intrinsic::min) {
      const uint64_t a = arguments[0][i];
      const uint64_t b = arguments[1][i];
      const auto less = fold_binary(ir::BinaryOp::kLess, scalar, a, b);
      if (!less || is_floating(scalar)) return std::nullopt;
      result.push_back((*less != 0) != is_max ? a : b);
    } else {
      return std::nullopt;
    }
  }
  return result;
}

Components evaluate_at(const ir::Expr* expression, int depth) {
  if (depth > 256) return std::nullopt;
  const ir::Expr* e = source_of(expression, 0);
  if (!e || component_count(e->type) == 0) return std::nullopt;
  const auto operand = [&](size_t index) { return evaluate_at(e->operands[index], depth + 1); };
  switch (e->kind) {
    case ir::ExprKind::kLiteral:
      return e->literal;
    case ir::ExprKind::kZero:
      return std::vector<uint64_t>(component_count(e->type),
                                   is_floating(e->type->scalar) ? float_bits(0) : 0);
    case ir::ExprKind::kConvert: {
      Components value = operand(0);
      if (!value) return std::nullopt;
      for (uint64_t& bits : *value) {
        bits = convert_bits(bits, e->operands[0]->type->scalar, e->type->scalar);
      }
      return value;
    }
    case ir::ExprKind::kSplat: {
      const Components value = operand(0);
      if (!value) return std::nullopt;
      return std::vector<uint64_t>(component_count(e->type), (*value)[0]);
    }
    case ir::ExprKind::kTruncate: {
      const Components value = operand(0);
      return value ? evaluate_truncation(e, *value) : std::nullopt;
    }
    case ir::ExprKind::kSwizzle: {
      const Components value = operand(0);
      if (!value) return std::nullopt;
      std::vector<uint64_t> result;
      for (const uint8_t component : e->components) result.push_back((*value)[component]);
      return result;
    }
    case ir::ExprKind::kMatrixSwizzle: {
      const Components value = operand(0);
      if (!value) return std::nullopt;
      std::vector<uint64_t> result;
      for (const uint8_t component : e->components) {
        result.push_back((*value)[component / 4u * e->operands[0]->type->columns + component % 4u]);
      }
      return result;
    }
    case ir::ExprKind::kElement:
      return evaluate_element(e, depth + 1);
    case ir::ExprKind::kConstruct: {
      std::vector<uint64_t> result;
      for (size_t i = 0; i < e->operands.size(); ++i) {
        const Components part = operand(i);
        if (!part) return std::nullopt;
        result.insert(result.end(), part->begin(), part->end());
      }
      return result.size() == component_count(e->type) ? Components(result) : std::nullopt;
    }
    case ir::ExprKind::kUnary: {
      Components value = operand(0);
      if (!value) return std::nullopt;
      for (uint64_t& bits : *value) {
        const auto folded = fold_unary(e->unary, e->type->scalar, bits);
        if (!folded) return std::nullopt;
        bits = *folded;
      }
      return value;
    }
    case ir::ExprKind::kBinary:
      return evaluate_pair(e, depth + 1);
    case ir::ExprKind::kConditional: {
      const Components condition = operand(0);
      if (!condition) return std::nullopt;
      return operand((*condition)[0] ? 1 : 2);
    }
    case ir::ExprKind::kSelect: {
      const Components condition = operand(0);
      const Components yes = operand(1);
      const Components no = operand(2);
      if (!condition || !yes || !no) return std::nullopt;
      std::vector<uint64_t> result;
      for (size_t i = 0; i < yes->size(); ++i) {
        const bool chosen = (*condition)[condition->size() == 1 ? 0 : i] != 0;
        result.push_back(chosen ? (*yes)[i] : (*no)[i]);
      }
      return result;
    }
    case ir::ExprKind::kLogicalAnd:
    case ir::ExprKind::kLogicalOr: {
      const Components left = operand(0);
      if (!left) return std::nullopt;
      const bool decides = ((*left)[0] != 0) == (e->kind == ir::ExprKind::kLogicalOr);
      return decides ? left : operand(1);
    }
    case ir::ExprKind::kIntrinsic:
      return evaluate_intrinsic(e, depth + 1);
    default:
      return std::nullopt;
  }
}

bool is_constant_at(const ir::Expr* e, int depth) {
  if (depth > 256) return false;
  switch (e->kind) {
    case ir::ExprKind::kLiteral:
    case ir::ExprKind::kZero:
      return true;
    case ir::ExprKind::kVariable:
      return e->variable->storage == ir::Storage::kConstant;
    case ir::ExprKind::kSystemValue:
    case ir::ExprKind::kBinding:
    case ir::ExprKind::kHeapResource:
    case ir::ExprKind::kPrintBuffer:
    case ir::ExprKind::kLoad:
    case ir::ExprKind::kLoadElement:
    case ir::ExprKind::kTypedLoad:
    case ir::ExprKind::kSample:
    case ir::ExprKind::kDimensions:
    case ir::ExprKind::kQueryValue:
    case ir::ExprKind::kTrianglePositions:
    case ir::ExprKind::kClusterId:
      return false;
    default:
      return std::all_of(e->operands.begin(), e->operands.end(), [depth](const ir::Expr* operand) {
        return is_constant_at(operand, depth + 1);
      });
  }
}

}  // namespace

uint64_t float_bits(double value) {
  return std::bit_cast<uint64_t>(value);
}
double float_value(uint64_t bits) {
  return std::bit_cast<double>(bits);
}

uint64_t normalise_bits(uint64_t bits, Scalar scalar) {
  switch (scalar) {
    case Scalar::kBool:
      return bits != 0;
    case Scalar::kInt16:
      return static_cast<uint64_t>(int64_t{static_cast<int16_t>(bits)});
    case Scalar::kUint16:
      return static_cast<uint16_t>(bits);
    case Scalar::kInt32:
      return static_cast<uint64_t>(int64_t{static_cast<int32_t>(bits)});
    case Scalar::kUint32:
      return static_cast<uint32_t>(bits);
    case Scalar::kFloat16:
      return float_bits(round_to_half(float_value(bits)));
    case Scalar::kFloat32:
      return float_bits(static_cast<double>(static_cast<float>(float_value(bits))));
    default:
      return bits;
  }
}

uint64_t convert_bits(uint64_t bits, Scalar from, Scalar to) {
  if (from == to) return bits;
  if (is_floating(from)) {
    const double value = float_value(bits);
    if (to == Scalar::kBool) return value != 0;
    if (is_floating(to)) return normalise_bits(bits, to);
    return normalise_bits(saturate_to_integer(value, to), to);
  }
  if (to == Scalar::kBool) return bits != 0;
  if (!is_floating(to)) return normalise_bits(bits, to);
  const double value =
      is_signed(from) ? static_cast<double>(static_cast<int64_t>(bits)) : static_cast<double>(bits);
  return normalise_bits(float_bits(value), to);
}

std::optional<uint64_t> fold_binary(ir::BinaryOp op, Scalar scalar, uint64_t left, uint64_t right) {
  if (is_floating(scalar)) {
    const double a = float_value(left);
    const double b = float_value(right);
    if (is_comparison(op)) return compare(op, a, b);
    const auto value = float_operation(op, a, b);
    if (!value) return std::nullopt;
    return normalise_bits(float_bits(*value), scalar);
  }
  if (is_comparison(op)) {
    return is_signed(scalar) ? compare(op, static_cast<int64_t>(left), static_cast<int64_t>(right))
                             : compare(op, left, right);
  }
  const auto value = integer_operation(op, scalar, left, right);
  if (!value) return std::nullopt;
  return normalise_bits(*value, scalar);
}

std::optional<uint64_t> fold_unary(ir::UnaryOp op, Scalar scalar, uint64_t operand) {
  switch (op) {
    case ir::UnaryOp::kNegate:
      if (is_floating(scalar)) return float_bits(-float_value(operand));
      return normalise_bits(uint64_t{0} - operand, scalar);
    case ir::UnaryOp::kNot:
      return operand == 0;
    case ir::UnaryOp::kBitNot:
      if (is_floating(scalar)) return std::nullopt;
      return normalise_bits(~operand, scalar);
  }
  return std::nullopt;
}

std::optional<std::vector<uint64_t>> evaluate(const ir::Expr* expression) {
  return evaluate_at(expression, 0);
}

bool is_constant(const ir::Expr* expression) {
  return is_constant_at(expression, 0);
}

}  // namespace kaamos::hlsl
