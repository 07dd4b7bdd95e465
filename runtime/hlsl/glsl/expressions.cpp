// SPDX-License-Identifier: MIT
//
// Expressions: GLSL's own operators if they mean the same as HLSL's, otherwise the prelude's
// functions.
#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/glsl/emitter.h"
#include "runtime/hlsl/ir/operators.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

bool is_vector(const Type* type) {
  return type->kind == TypeKind::kVector && type->columns > 1;
}

bool is_arithmetic(BinaryOp op) {
  return op <= BinaryOp::kBitXor;  // those that also have an operator for vectors
}

}  // namespace

std::string GlslEmitter::hoist(const std::string& type, const std::string& text) {
  const std::string name = "g_t" + std::to_string(next_temporary_++);
  line(type + " " + name + " = " + text + ";");
  return name;
}

std::string GlslEmitter::repeatable(const Expr* expr) {
  if (expr->kind == ExprKind::kVariable || expr->kind == ExprKind::kZero ||
      (expr->kind == ExprKind::kLiteral && expr->type->kind == TypeKind::kScalar)) {
    return value(expr);
  }
  const std::string text = value(expr);
  return hoist(type(expr->type), text);
}

std::string GlslEmitter::call(std::string_view function,
                              const std::vector<const Expr*>& arguments) {
  std::string out(function);
  out += '(';
  for (size_t i = 0; i < arguments.size(); ++i) {
    out += i == 0 ? "" : ", ";
    out += value(arguments[i]);
  }
  return out + ')';
}

std::string GlslEmitter::Path::guard() const {
  std::string out;
  for (const std::string& g : guards) {
    out += (out.empty() ? "" : " && ") + g;
  }
  return out;
}

// The text of an in-range index, for one that may be out of range.
std::string GlslEmitter::element_index(const Expr* index, uint32_t count, Path& out) {
  if (index->kind == ExprKind::kLiteral) {
    if (static_cast<uint32_t>(index->literal[0]) < count) {
      return std::to_string(static_cast<uint32_t>(index->literal[0]));
    }
    out.guards.push_back("false");
    return "0";
  }
  const std::string text = value(index);
  const std::string unsigned_text =
      index->type->scalar == Scalar::kUint32 ? text : "uint(" + text + ")";
  const std::string name =
      index->kind == ExprKind::kVariable ? unsigned_text : hoist("uint", unsigned_text);
  out.guards.push_back("(" + name + " < " + glsl::number(count) + ")");
  return "min(" + name + ", " + glsl::number(count - 1) + ")";
}

GlslEmitter::Path GlslEmitter::path(const Expr* e) {
  const Expr& expr = *e;
  switch (expr.kind) {
    case ExprKind::kVariable:
      return {variable(expr.variable), {}};
    case ExprKind::kField: {
      Path out = path(expr.operands[0]);
      out.text += "." + field(expr.operands[0]->type->structure, expr.index);
      return out;
    }
    case ExprKind::kElement: {
      Path out = path(expr.operands[0]);
      const Type* indexed = expr.operands[0]->type;
      if (indexed->kind == TypeKind::kArray) {
        out.text += "[" + element_index(expr.operands[1], indexed->count, out) + "]";
      } else if (indexed->kind == TypeKind::kMatrix) {
        out.text += ".r[" + element_index(expr.operands[1], indexed->rows, out) + "]";
      } else if (is_vector(indexed)) {
        out.text += "[" + element_index(expr.operands[1], indexed->columns, out) + "]";
      }
      return out;
    }
    case ExprKind::kSwizzle: {
      Path out = path(expr.operands[0]);
      if (is_vector(expr.operands[0]->type)) {
        out.text += ".";
        for (const uint8_t c : expr.components) {
          out.text += glsl::component(c);
        }
      }
      return out;
    }
    case ExprKind::kMatrixSwizzle: {
      Path out = path(expr.operands[0]);
      out.text += ".r[" + std::to_string(expr.components[0] / 4) + "]";
      if (expr.operands[0]->type->columns > 1) {
        out.text += "." + glsl::component(expr.components[0] % 4);
      }
      return out;
    }
    default:
      return {value(e), {}};
  }
}

std::string GlslEmitter::construct(const Expr& expr) {
  const Type* t = expr.type;
  if (t->kind == TypeKind::kMatrix) {
    return matrix_construct(expr);
  }
  if (t->kind == TypeKind::kScalar || (t->kind == TypeKind::kVector && t->columns == 1)) {
    return value(expr.operands[0]);
  }
  if (expr.operands.empty()) {
    return zero(t);
  }
  return call(type(t), expr.operands);
}

std::string GlslEmitter::convert(const Expr& expr) {
  const Type* from = expr.operands[0]->type;
  const Type* to = expr.type;
  const std::string function = std::string("k_to_") + glsl::suffix(to->scalar);
  if (to->kind == TypeKind::kMatrix) {
    return matrix_call(function, to, expr.operands);
  }
  // GLSL's constructors wrap integers, and round integers and doubles, as HLSL does.
  const bool plain = to->scalar == Scalar::kFloat32 || to->scalar == Scalar::kFloat64 ||
                     (!is_floating(from->scalar) && !is_floating(to->scalar)) ||
                     to->scalar == Scalar::kBool;
  return call(plain ? type(to) : function, expr.operands);
}

std::string GlslEmitter::swizzle(const Expr& expr) {
  const Expr* from = expr.operands[0];
  if (is_vector(from->type)) {
    const Path p = path(&expr);
    return p.guards.empty() ? p.text
                            : "(" + p.guard() + " ? " + p.text + " : " + zero(expr.type) + ")";
  }
  return expr.components.size() == 1 ? value(from) : type(expr.type) + "(" + value(from) + ")";
}

std::string GlslEmitter::unary(const Expr& expr) {
  const Type* t = expr.type;
  if (t->kind == TypeKind::kMatrix) {
    constexpr const char* kNames[] = {"k_negate", "k_not", "k_bit_not"};
    return matrix_call(kNames[static_cast<int>(expr.unary)], t, expr.operands);
  }
  switch (expr.unary) {
    case UnaryOp::kNegate:
      return "(-" + value(expr.operands[0]) + ")";
    case UnaryOp::kNot:
      if (expr.operands[0]->type->scalar != Scalar::kBool) {
        return call("k_not", expr.operands);
      }
      return (is_vector(t) ? "not(" : "(!") + value(expr.operands[0]) + ")";
    case UnaryOp::kBitNot:
      return t->scalar == Scalar::kBool ? call("k_bit_not", expr.operands)
                                        : "(~" + value(expr.operands[0]) + ")";
  }
  return "";
}

std::string GlslEmitter::binary(const Expr& expr) {
  const Type* operand = expr.operands[0]->type;
  const BinarySpelling& spelling = spelling_of(expr.binary);
  if (operand->kind == TypeKind::kMatrix) {
    return matrix_call(spelling.glsl, expr.type, expr.operands);
  }
  const bool boolean = operand->scalar == Scalar::kBool;
  const bool equality = expr.binary == BinaryOp::kEqual || expr.binary == BinaryOp::kNotEqual;
  const bool native = spelling.is_native && (!boolean || (equality && !is_vector(operand))) &&
                      (!is_vector(operand) || is_arithmetic(expr.binary));
  if (native) {
    return "(" + value(expr.operands[0]) + " " + spelling.symbol + " " + value(expr.operands[1]) +
           ")";
  }
  return call(spelling.glsl, expr.operands);
}

std::string GlslEmitter::intrinsic(const Expr& expr) {
  bool matrix = expr.type->kind == TypeKind::kMatrix;
  for (const Expr* operand : expr.operands) {
    matrix = matrix || operand->type->kind == TypeKind::kMatrix;
  }
  if (matrix) {
    return matrix_intrinsic(expr);
  }
  if (expr.intrinsic == Intrinsic::mul) {
    const Type* a = expr.operands[0]->type;
    const Type* b = expr.operands[1]->type;
    if (is_vector(a) && is_vector(b)) {
      return call("k_dot", expr.operands);
    }
    return "(" + value(expr.operands[0]) + " * " + value(expr.operands[1]) + ")";
  }
  return call("k_" + std::string(name_of(expr.intrinsic)), expr.operands);
}

std::string GlslEmitter::value(const Expr* e) {
  const Expr& expr = *e;
  const bool matrix = expr.type->kind == TypeKind::kMatrix;
  switch (expr.kind) {
    case ExprKind::kLiteral:
      return literal(expr);
    case ExprKind::kZero:
      return zero(expr.type);
    case ExprKind::kVariable:
      return variable(expr.variable);
    case ExprKind::kField:
    case ExprKind::kElement: {
      const Path p = path(e);
      return p.guards.empty() ? p.text
                              : "(" + p.guard() + " ? " + p.text + " : " + zero(expr.type) + ")";
    }
    case ExprKind::kSwizzle:
      return swizzle(expr);
    case ExprKind::kMatrixSwizzle:
      return matrix_swizzle(expr);
    case ExprKind::kConvert:
      return convert(expr);
    case ExprKind::kSplat:
      return matrix ? matrix_splat(expr) : call(type(expr.type), expr.operands);
    case ExprKind::kTruncate: {
      const Type* from = expr.operands[0]->type;
      if (from->kind == TypeKind::kMatrix) {
        return matrix_truncate(expr);
      }
      return is_vector(from)
                 ? value(expr.operands[0]) + "." + std::string("xyzw").substr(0, expr.type->columns)
                 : value(expr.operands[0]);
    }
    case ExprKind::kConstruct:
      return construct(expr);
    case ExprKind::kUnary:
      return unary(expr);
    case ExprKind::kBinary:
      return binary(expr);
    case ExprKind::kSelect:
      return matrix ? matrix_call("k_select", expr.type, expr.operands)
                    : call("k_select", expr.operands);
    case ExprKind::kConditional:
      return "(" + value(expr.operands[0]) + " ? " + value(expr.operands[1]) + " : " +
             value(expr.operands[2]) + ")";
    case ExprKind::kLogicalAnd:
      return "(" + value(expr.operands[0]) + " && " + value(expr.operands[1]) + ")";
    case ExprKind::kLogicalOr:
      return "(" + value(expr.operands[0]) + " || " + value(expr.operands[1]) + ")";
    case ExprKind::kIntrinsic:
      return intrinsic(expr);
    case ExprKind::kSystemValue:
      return system_value(expr);
    case ExprKind::kQueryValue:
      return query_value(expr);
    case ExprKind::kBinding:
      return binding(expr);
    case ExprKind::kPrintBuffer:
      return print_buffer();
    case ExprKind::kHeapResource: {
      if (module_.check_access) {
        const ResourceClass c = class_of(expr.type->resource);
        return "k_heap_resource_checked(" + value(expr.operands[0]) + ", " +
               glsl::number(static_cast<uint32_t>(c.kind)) + ", " +
               glsl::number(static_cast<uint32_t>(c.access)) + ", " + site(expr.location) + ")";
      }
      const bool sampler = expr.type->resource == ResourceKind::kSampler ||
                           expr.type->resource == ResourceKind::kSamplerComparison;
      return "k_heap_resource(" + value(expr.operands[0]) + (sampler ? ", true)" : ", false)");
    }
    case ExprKind::kLoad:
    case ExprKind::kLoadElement:
      return load(expr);
    case ExprKind::kTypedLoad:
      return typed_load(expr);
    case ExprKind::kSample:
      return sample(expr);
    case ExprKind::kDimensions:
      return dimensions(expr);
    case ExprKind::kSameBytes:
      return same_bytes(expr);
    case ExprKind::kRecordConstant:
      return record_constant(expr);
    case ExprKind::kTrianglePositions:
      return triangle_positions(expr);
    case ExprKind::kClusterId:
      return cluster_id(expr);
    case ExprKind::kQuad:  // a statement by now
      break;
  }
  return "";
}

}  // namespace kaamos::hlsl
