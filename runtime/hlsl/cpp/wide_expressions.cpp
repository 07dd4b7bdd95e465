// SPDX-License-Identifier: MIT
//
// Expressions with varying values. Uniform ones come from the scalar emitter and are spread over
// the lanes if a varying value is needed. Anything that can read outside a buffer without bounds is
// done under the mask of the lanes that need it.
#include <algorithm>

#include "runtime/hlsl/cpp/wide_emitter.h"
#include "runtime/hlsl/ir/operators.h"
#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

bool has_access(const Expr* root) {
  bool found = false;
  visit_expr(root, [&](const Expr& expr) {
    found = found || expr.kind == ExprKind::kLoad || expr.kind == ExprKind::kLoadElement ||
            expr.kind == ExprKind::kTypedLoad || expr.kind == ExprKind::kSample;
  });
  return found;
}

// Returns whether the prelude's function for the intrinsic takes wide values of the scalar type:
// component-wise functions do, and so does geometry on types that fit registers.
bool takes_wide(Intrinsic intrinsic, Scalar scalar) {
  switch (intrinsic) {
    case Intrinsic::determinant:
    case Intrinsic::dst:
    case Intrinsic::faceforward:
    case Intrinsic::lit:
    case Intrinsic::msad4:
    case Intrinsic::reflect:
    case Intrinsic::refract:
      return false;
    case Intrinsic::distance:
    case Intrinsic::dot:
    case Intrinsic::length:
    case Intrinsic::mul:
    case Intrinsic::normalize:
      return scalar == Scalar::kFloat32 || scalar == Scalar::kInt32 || scalar == Scalar::kUint32;
    default:
      return true;
  }
}

}  // namespace

std::string WideEmitter::value(const Expr* expr) {
  if (is_varying(expr)) return varying(*expr);
  return "ks::spread<" + type(expr->type) + ">(" + out_.value(expr) + ")";
}

std::string WideEmitter::call(std::string_view function,
                              const std::vector<const Expr*>& arguments) {
  std::string out(function);
  out += '(';
  for (size_t i = 0; i < arguments.size(); ++i) {
    out += i == 0 ? "" : ", ";
    out += value(arguments[i]);
  }
  return out + ')';
}

std::string WideEmitter::field(const Expr& expr) {
  return "m_" + out_.field_names_[expr.operands[0]->type->structure][expr.index];
}

std::string WideEmitter::intrinsic(const Expr& expr) {
  const std::string name = "ks::" + std::string(name_of(expr.intrinsic));
  if (takes_wide(expr.intrinsic, expr.operands[0]->type->scalar)) return call(name, expr.operands);
  std::string out = "ks::call_lanes<" + type(expr.type) +
                    ">([](const auto&... x) KAAMOS_INLINE_LAMBDA { return " + name + "(x...); }";
  for (const Expr* operand : expr.operands) out += ", " + value(operand);
  return out + ")";
}

std::string WideEmitter::element(const Expr& expr) {
  const Expr* base = expr.operands[0];
  const Expr* index = expr.operands[1];
  const Type* indexed = base->type;
  if (indexed->kind == TypeKind::kScalar) return value(base);  // a vector of one component
  if (is_varying(index)) {
    const std::string only = behind_row(indexed);
    const std::string row = only.empty() ? type(expr.type) : "ks::vec<" + type(expr.type) + ", 1>";
    return "ks::element_at<" + row + ">(" + (is_varying(base) ? varying(*base) : out_.value(base)) +
           ", " + varying(*index) + ")" + only;
  }
  const uint32_t count = indexed->kind == TypeKind::kArray    ? indexed->count
                         : indexed->kind == TypeKind::kMatrix ? indexed->rows
                                                              : indexed->columns;
  if (index->kind == ExprKind::kLiteral && index->literal[0] < count) {
    return varying(*base) + "[" + std::to_string(index->literal[0]) + "]" + behind_row(indexed);
  }
  return "ks::element(" + varying(*base) + ", " + out_.value(index) + ")" + behind_row(indexed);
}

std::string WideEmitter::construct(const Expr& expr) {
  const Type* t = expr.type;
  const bool scalars =
      std::all_of(expr.operands.begin(), expr.operands.end(),
                  [](const Expr* operand) { return operand->type->kind == TypeKind::kScalar; });
  if (t->kind == TypeKind::kMatrix || (t->kind == TypeKind::kVector && !scalars)) {
    return call("ks::make<" + type(t) + ">", expr.operands);
  }
  if (t->kind == TypeKind::kScalar) return value(expr.operands[0]);
  std::string out = type(t) + "{";
  for (size_t i = 0; i < expr.operands.size(); ++i) {
    out += (i == 0 ? "" : ", ") + value(expr.operands[i]);
  }
  return out + "}";
}

std::string WideEmitter::under_mask(const std::function<std::string()>& text) {
  const std::string outer = mask_;
  mask_ = out_.local_names_.declare("mask");
  const std::string body = text();
  const std::string out = "[&]([[maybe_unused]] const ks::lanes& " + mask_ +
                          ") KAAMOS_INLINE_LAMBDA { return " + body + "; }";
  mask_ = outer;
  return out;
}

std::string WideEmitter::conditional(const Expr& expr) {
  const Expr* condition = expr.operands[0];
  const Expr* first = expr.operands[1];
  const Expr* second = expr.operands[2];
  if (!is_varying(condition)) {
    return "(" + out_.value(condition) + " ? " + value(first) + " : " + value(second) + ")";
  }
  if (!has_access(first) && !has_access(second)) {
    return "ks::select(" + varying(*condition) + ", " + value(first) + ", " + value(second) + ")";
  }
  return "ks::choose<" + type(expr.type) + ">(" + mask_ + ", " + varying(*condition) + ", " +
         under_mask([&] { return value(first); }) + ", " +
         under_mask([&] { return value(second); }) + ")";
}

std::string WideEmitter::logical(const Expr& expr) {
  const bool is_and = expr.kind == ExprKind::kLogicalAnd;
  const Expr* first = expr.operands[0];
  const Expr* second = expr.operands[1];
  if (!is_varying(first)) {
    const std::string known =
        "ks::spread<ks::lanes>(" + std::string(is_and ? "false" : "true") + ")";
    return "(" + out_.value(first) + " ? " + (is_and ? value(second) : known) + " : " +
           (is_and ? known : value(second)) + ")";
  }
  if (!has_access(second)) {
    return "(" + varying(*first) + (is_and ? " & " : " | ") + value(second) + ")";
  }
  return std::string(is_and ? "ks::both(" : "ks::either(") + mask_ + ", " + varying(*first) + ", " +
         under_mask([&] { return value(second); }) + ")";
}

void WideEmitter::add_operand(LaneOperands& operands, const Expr* expr) {
  if (operands.text.count(expr) != 0) return;
  const std::string name = out_.local_names_.declare("operand");
  const bool varies = is_varying(expr);
  operands.captures += ", " + name + " = " + (varies ? varying(*expr) : out_.value(expr));
  operands.text[expr] = varies ? "ks::get(" + name + ", lane_number)" : name;
}

std::string WideEmitter::gather(const Expr& expr, const LaneOperands& operands,
                                const std::string& text) {
  return "ks::gather_lanes<" + type(expr.type) + ">(" + mask_ + ", [&" + operands.captures +
         "](int lane_number) KAAMOS_INLINE_LAMBDA { return " + text + "; })";
}

// The buffer view for one lane. `accessed` are the operands of a load or a store.
std::string WideEmitter::buffer_view(LaneOperands& operands,
                                     const std::vector<const Expr*>& accessed, bool element) {
  for (const Expr* operand : accessed) {
    if (operand == accessed[0] && out_.is_looked_up(*operand)) continue;
    add_operand(operands, operand);
  }
  return out_.buffer_view(*accessed[0], element ? accessed[1] : nullptr,
                          [&](const Expr* e) { return operands.text.at(e); });
}

std::string WideEmitter::load(const Expr& expr) {
  LaneOperands operands;
  const bool element = expr.kind == ExprKind::kLoadElement;
  // The one operand that says where the lanes read, if only one is varying.
  const Expr* at = element ? expr.operands[1] : expr.operands.back();
  const bool is_at =
      std::all_of(expr.operands.begin(), expr.operands.end(),
                  [&](const Expr* operand) { return (operand == at) == is_varying(operand); });
  if (is_at) {
    operands.text[at] = "lane_value";
    const std::string view = buffer_view(operands, expr.operands, element);
    const auto offset = expr.operands.back();
    return "ks::gather_at<" + type(expr.type) + ">(" + mask_ + ", " + varying(*at) + ", [&" +
           operands.captures + "](auto lane_value) KAAMOS_INLINE_LAMBDA { return " +
           out_.memory_read(expr.type, expr.layout, expr.row_major, view,
                            operands.text.at(offset)) +
           "; })";
  }
  const std::string view = buffer_view(operands, expr.operands, element);
  return gather(expr, operands,
                out_.memory_read(expr.type, expr.layout, expr.row_major, view,
                                 operands.text.at(expr.operands.back())));
}

bool WideEmitter::has_texel_row(const Variable* variable) const {
  const Type* t = variable->type;
  return current_->is_varying(variable) && current_->written.count(variable) == 0 &&
         t->kind == TypeKind::kVector && t->columns == 2 &&
         (t->scalar == Scalar::kInt32 || t->scalar == Scalar::kUint32);
}

// The row known for texel coordinates that are a uniform distance away from others; empty if none
// is known.
std::string WideEmitter::texel_row(const Expr* at) {
  if (at->kind == ExprKind::kVariable) {
    const auto known = texel_rows_.find(at->variable);
    return known != texel_rows_.end() ? known->second : "";
  }
  const bool adds = at->kind == ExprKind::kBinary && at->binary == BinaryOp::kAdd;
  if (!adds && !(at->kind == ExprKind::kBinary && at->binary == BinaryOp::kSubtract)) return "";
  const Expr* from = at->operands[0];
  const Expr* by = at->operands[1];
  if (adds && !is_varying(from)) std::swap(from, by);
  if (!is_varying(from) || is_varying(by)) return "";
  const std::string row = texel_row(from);
  if (row.empty()) return "";
  const std::string way = adds ? out_.value(by) : "ks::negate(" + out_.value(by) + ")";
  return "ks::moved(" + row + ", " + way + ")";
}

std::string WideEmitter::texel_coordinates(const Expr* at) {
  const std::string row = texel_row(at);
  if (row.empty()) return value(at);
  return row + ", [&]() KAAMOS_INLINE_LAMBDA { return " + value(at) + "; }";
}

std::string WideEmitter::typed_load(const Expr& expr) {
  const Type* resource = expr.operands[0]->type;
  const std::string result = "<" + out_.type(expr.type) + ">(ctx.invocation, ";
  const bool buffer =
      resource->resource == ResourceKind::kBuffer || resource->resource == ResourceKind::kRWBuffer;
  const Expr* mip = expr.operands.size() > 2 ? expr.operands[2] : nullptr;
  const Expr* offset = expr.operands.size() > 3 ? expr.operands[3] : nullptr;
  const bool first_mip =
      mip == nullptr || (mip->kind == ExprKind::kLiteral && mip->literal[0] == 0);
  const bool plain = resource->resource == ResourceKind::kTexture2D ||
                     resource->resource == ResourceKind::kRWTexture2D;
  if (plain && first_mip && offset == nullptr && out_.is_looked_up(*expr.operands[0]) &&
      expr.operands[1]->type->columns == 2) {
    return "ks::load_texels" + result + out_.texture(expr.operands[0]) + ", " +
           texel_coordinates(expr.operands[1]) + ", " + mask_ + ")";
  }
  LaneOperands operands;
  for (size_t i = 1; i < expr.operands.size(); ++i) add_operand(operands, expr.operands[i]);
  const auto text = [&](const Expr* e) {
    return e != nullptr ? operands.text.at(e) : std::string();
  };
  const std::string at = text(expr.operands[1]);
  if (buffer) {
    return gather(
        expr, operands,
        "ks::load_typed" + result + out_.value(expr.operands[0]) + ", uint32_t(" + at + "))");
  }
  return gather(
      expr, operands,
      "ks::load_texel" + result + out_.texture(expr.operands[0]) + ", " +
          out_.texel_coordinates_text(
              resource, at, mip != nullptr ? "int32_t(" + text(mip) + ")" : "0", text(offset)) +
          ")");
}

std::string WideEmitter::sample(const Expr& expr) {
  LaneOperands operands;
  for (const Expr* operand : expr.operands) add_operand(operands, operand);
  return gather(expr, operands,
                out_.sample_text(expr, [&](const Expr* e) { return operands.text.at(e); }));
}

std::string WideEmitter::dimensions(const Expr& expr) {
  LaneOperands operands;
  for (const Expr* operand : expr.operands) add_operand(operands, operand);
  return gather(expr, operands,
                "ks::dimensions(ctx.invocation, " + operands.text.at(expr.operands[0]) +
                    ", uint32_t(" + operands.text.at(expr.operands[1]) + "))");
}

std::string WideEmitter::varying(const Expr& expr) {
  switch (expr.kind) {
    case ExprKind::kVariable:
      return out_.variable(expr.variable);
    case ExprKind::kField:
      return varying(*expr.operands[0]) + "." + field(expr);
    case ExprKind::kElement:
      return element(expr);
    case ExprKind::kSwizzle:
      return call("ks::swizzle<" + component_list(expr.components) + ">", expr.operands);
    case ExprKind::kMatrixSwizzle:
      return call("ks::matrix_swizzle<" + component_list(expr.components) + ">", expr.operands);
    case ExprKind::kConvert:
      return call(std::string("ks::convert<") + scalar_name(expr.type->scalar) + ">",
                  expr.operands);
    case ExprKind::kSplat:
      return call("ks::splat<" + type(expr.type) + ">", expr.operands);
    case ExprKind::kTruncate:
      return call("ks::truncate<" + type(expr.type) + ">", expr.operands);
    case ExprKind::kConstruct:
      return construct(expr);
    case ExprKind::kUnary:
      return call(expr.unary == UnaryOp::kNegate ? "ks::negate"
                  : expr.unary == UnaryOp::kNot  ? "ks::logical_not"
                                                 : "ks::bit_not",
                  expr.operands);
    case ExprKind::kBinary:
      return call(spelling_of(expr.binary).cpp, expr.operands);
    case ExprKind::kSelect:
      if (!is_varying(expr.operands[0]) && expr.operands[0]->type->kind == TypeKind::kScalar) {
        return "ks::select(" + out_.value(expr.operands[0]) + ", " + value(expr.operands[1]) +
               ", " + value(expr.operands[2]) + ")";
      }
      return call("ks::select", expr.operands);
    case ExprKind::kConditional:
      return conditional(expr);
    case ExprKind::kLogicalAnd:
    case ExprKind::kLogicalOr:
      return logical(expr);
    case ExprKind::kIntrinsic:
      return intrinsic(expr);
    case ExprKind::kLoad:
    case ExprKind::kLoadElement:
      return load(expr);
    case ExprKind::kTypedLoad:
      return typed_load(expr);
    case ExprKind::kSample:
      return sample(expr);
    case ExprKind::kDimensions:
      return dimensions(expr);
    case ExprKind::kSystemValue:
      return "ctx.rays_index";
    default:
      return "";  // never varying, or rejected by the plan
  }
}

std::string WideEmitter::place(const Expr* e) {
  const Expr& expr = *e;
  const auto base = [&] { return place(expr.operands[0]); };
  switch (expr.kind) {
    case ExprKind::kField:
      return base() + "." + field(expr);
    case ExprKind::kElement: {
      if (expr.operands[0]->type->kind == TypeKind::kScalar) return base();
      return "ks::element_ref(" + base() + ", " + out_.value(expr.operands[1]) + ")" +
             behind_row(expr.operands[0]->type);
    }
    case ExprKind::kSwizzle:
      return expr.operands[0]->type->kind == TypeKind::kScalar
                 ? base()
                 : base() + "[" + std::to_string(expr.components[0]) + "]";
    case ExprKind::kMatrixSwizzle:
      return base() + "[" + std::to_string(expr.components[0] / 4) + "][" +
             std::to_string(expr.components[0] % 4) + "]";
    default:
      return out_.variable(expr.variable);
  }
}

}  // namespace kaamos::hlsl
