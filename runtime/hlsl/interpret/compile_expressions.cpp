// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cstring>

#include "runtime/hlsl/interpret/compiler.h"
#include "runtime/hlsl/interpret/evaluate.h"
#include "runtime/hlsl/interpret/kernels.h"

namespace kaamos::hlsl::interpret {

using namespace ir;

namespace {

template <class T>
void put(std::byte* at, T value) {
  std::memcpy(at, &value, sizeof(value));
}

void put_scalar(std::byte* at, Scalar scalar, uint64_t bits) {
  switch (scalar) {
    case Scalar::kBool:
      return put(at, bits != 0);
    case Scalar::kInt16:
    case Scalar::kUint16:
      return put(at, static_cast<uint16_t>(bits));
    case Scalar::kInt32:
    case Scalar::kUint32:
      return put(at, static_cast<uint32_t>(bits));
    case Scalar::kInt64:
    case Scalar::kUint64:
    case Scalar::kFloat64:
      return put(at, bits);
    case Scalar::kFloat16:
      return put(at, shader::to_half(static_cast<float>(std::bit_cast<double>(bits))));
    case Scalar::kFloat32:
      return put(at, static_cast<float>(std::bit_cast<double>(bits)));
    default:  // Only plain ones get here.
      break;
  }
}

std::vector<uint8_t> first_components(uint32_t count) {
  std::vector<uint8_t> out(count);
  for (uint32_t i = 0; i < count; ++i) out[i] = static_cast<uint8_t>(i);
  return out;
}

// The upper left part of a matrix, or the leading components.
std::vector<uint8_t> truncated_components(const Type* to, const Type* from) {
  if (to->kind != TypeKind::kMatrix || from->kind != TypeKind::kMatrix) {
    return first_components(component_count(to));
  }
  std::vector<uint8_t> out;
  for (uint8_t r = 0; r < to->rows; ++r) {
    for (uint8_t c = 0; c < to->columns; ++c) {
      out.push_back(static_cast<uint8_t>(r * from->columns + c));
    }
  }
  return out;
}

std::vector<uint8_t> transposed_components(const Type* from) {
  std::vector<uint8_t> out;
  for (uint8_t c = 0; c < from->columns; ++c) {
    for (uint8_t r = 0; r < from->rows; ++r) {
      out.push_back(static_cast<uint8_t>(r * from->columns + c));
    }
  }
  return out;
}

}  // namespace

void Compiler::need_zeros(uint32_t bytes) {
  if (program_.zeros.size() < bytes) program_.zeros.resize(bytes);
}

void Compiler::in_slot(Node& node, Evaluate evaluate) {
  node.evaluate = evaluate;
  node.slot = place({node.bytes, 8}, temporary_bytes_);
  most_temporary_bytes_ = std::max(most_temporary_bytes_, temporary_bytes_);
}

void Compiler::kernel(Node& node, Kernel found) {
  if (found == nullptr) program_.error = "an operation has no meaning for its operands' types";
  node.kernel = found;
  in_slot(node, evaluate_kernel());
}

void Compiler::gather(Node& node, std::vector<uint8_t> components) {
  node.stride = scalar_bytes(node.expr->type->scalar, ScalarStorage::kVariable);
  node.components = std::move(components);
  in_slot(node, evaluate_gather());
}

void Compiler::literal(Node& node) {
  const Expr& expr = *node.expr;
  auto& bytes = program_.constants.emplace_back(std::max(node.bytes, 1u));
  const uint32_t step = scalar_bytes(expr.type->scalar, ScalarStorage::kVariable);
  for (size_t i = 0; i < expr.literal.size() && i < node.count; ++i) {
    put_scalar(bytes.data() + i * step, expr.type->scalar, expr.literal[i]);
  }
  node.data = bytes.data();
  node.evaluate = evaluate_data();
}

Node* Compiler::variable_node(const Variable* variable, const Expr* expr) {
  Node& node = program_.nodes.emplace_back();
  if (places_.count(variable) == 0) {
    program_.error = "variable \"" + variable->name + "\" is used before it is declared";
  }
  const Place& place = places_[variable];
  node.expr = expr;
  node.bytes = bytes_of(variable->type);
  node.count = component_count(variable->type);
  node.offset = place.offset;
  node.data = place.data;
  make_variable(node, variable->storage, place.reference);
  if (variable->storage == Storage::kStaticGlobal) statics_.insert(variable);
  return &node;
}

void Compiler::element(Node& node) {
  const Type* indexed = node.expr->operands[0]->type;
  const Expr* index = node.expr->operands[1];
  const uint32_t count = indexed->kind == TypeKind::kArray    ? indexed->count
                         : indexed->kind == TypeKind::kMatrix ? indexed->rows
                                                              : indexed->columns;
  // A scalar acts as a vector with one component, whose index does not matter.
  const bool scalar = indexed->kind == TypeKind::kScalar;
  if (scalar || (index->kind == ExprKind::kLiteral && index->literal[0] < count)) {
    node.offset = scalar ? 0 : static_cast<uint32_t>(index->literal[0]) * node.bytes;
    node.evaluate = evaluate_member();
    node.locate = locate_member();
    return;
  }
  need_zeros(node.bytes);
  node.length = count;
  node.stride = node.bytes;
  node.evaluate = evaluate_element();
  node.locate = locate_element();
}

void Compiler::swizzle(Node& node, const Type* base) {
  std::vector<uint8_t> components = node.expr->components;
  if (node.expr->kind == ExprKind::kMatrixSwizzle) {
    for (uint8_t& c : components) c = static_cast<uint8_t>(c / 4 * base->columns + c % 4);
  }
  if (components.size() == 1) {
    node.offset = components[0] * scalar_bytes(base->scalar, ScalarStorage::kVariable);
    node.components = std::move(components);
    node.evaluate = evaluate_member();
    node.locate = locate_member();
  } else {
    gather(node, std::move(components));  // as a place, it is written by its statement
  }
}

void Compiler::construct(Node& node) {
  const Type* type = node.expr->type;
  uint32_t end = 0;
  for (size_t i = 0; i < node.operands.size(); ++i) {
    node.offsets.push_back(
        type->kind == TypeKind::kStruct
            ? program_.layouts.field_offset(*type->structure, static_cast<uint32_t>(i))
            : end);
    end += node.operands[i]->bytes;
  }
  in_slot(node, evaluate_construct());
}

void Compiler::intrinsic(Node& node) {
  const Expr& expr = *node.expr;
  const Type* first = expr.operands[0]->type;
  if (expr.intrinsic == Intrinsic::transpose) {
    gather(node, transposed_components(first));
    return;
  }
  if (expr.intrinsic == Intrinsic::any || expr.intrinsic == Intrinsic::all) {
    node.count = component_count(first);
  }
  if (expr.intrinsic == Intrinsic::mul) {
    const Type* second = expr.operands[1]->type;
    if (first->kind == TypeKind::kScalar || second->kind == TypeKind::kScalar) {
      node.inner = first->kind == TypeKind::kScalar ? 0 : 1;
    } else {
      node.rows = first->kind == TypeKind::kMatrix ? first->rows : 1;
      node.inner = first->columns;
      node.columns = second->kind == TypeKind::kMatrix ? second->columns : 1;
    }
  }
  kernel(node, find_intrinsic(expr));
}

void Compiler::compile(Node& node) {
  const Expr& expr = *node.expr;
  const Type* operand = expr.operands.empty() ? nullptr : expr.operands[0]->type;
  switch (expr.kind) {
    case ExprKind::kLiteral:
      return literal(node);
    case ExprKind::kZero:
      need_zeros(node.bytes);
      node.evaluate = evaluate_zero();
      return;
    case ExprKind::kVariable:
      return;  // done by variable_node
    case ExprKind::kField:
      node.offset = program_.layouts.field_offset(*operand->structure, expr.index);
      node.evaluate = evaluate_member();
      node.locate = locate_member();
      return;
    case ExprKind::kElement:
      return element(node);
    case ExprKind::kSwizzle:
    case ExprKind::kMatrixSwizzle:
      return swizzle(node, operand);
    case ExprKind::kConvert:
      return kernel(node, find_convert(expr.type->scalar, operand->scalar));
    case ExprKind::kSplat:
      return gather(node, std::vector<uint8_t>(node.count, 0));
    case ExprKind::kTruncate:
      return gather(node, truncated_components(expr.type, operand));
    case ExprKind::kConstruct:
      return construct(node);
    case ExprKind::kUnary:
      return kernel(node, find_unary(expr.unary, expr.type->scalar));
    case ExprKind::kBinary:
      return kernel(node, find_binary(expr.binary, operand->scalar));
    case ExprKind::kSelect:
      if (operand->kind != TypeKind::kScalar) return kernel(node, find_select(expr.type->scalar));
      node.evaluate = evaluate_conditional();  // pure, so the other operand need not run
      return;
    case ExprKind::kConditional:
      node.evaluate = evaluate_conditional();
      return;
    case ExprKind::kLogicalAnd:
      node.evaluate = evaluate_logical_and();
      return;
    case ExprKind::kLogicalOr:
      node.evaluate = evaluate_logical_or();
      return;
    case ExprKind::kIntrinsic:
      return intrinsic(node);
    case ExprKind::kSystemValue:
      reads_hit_kind_ = reads_hit_kind_ || expr.system_value == SystemValue::kHitKind;
      need_zeros(node.bytes);
      return in_slot(node, evaluate_system_value());
    case ExprKind::kQueryValue:
      return in_slot(node, evaluate_query_value());
    case ExprKind::kBinding:
      return in_slot(node, evaluate_binding());
    case ExprKind::kHeapResource:
      return in_slot(node, evaluate_heap_resource());
    case ExprKind::kPrintBuffer:
      return in_slot(node, evaluate_print_buffer());
    case ExprKind::kLoad:
    case ExprKind::kLoadElement:
      node.moves = moves_of(expr.type, expr.layout, expr.row_major);
      node.access = access_of(expr.type, expr.layout, expr.row_major);
      return in_slot(node,
                     expr.kind == ExprKind::kLoad ? evaluate_load() : evaluate_load_element());
    case ExprKind::kTypedLoad:
      return in_slot(node, evaluate_typed_load());
    case ExprKind::kSample:
      return in_slot(node, evaluate_sample());
    case ExprKind::kDimensions:
      return in_slot(node, evaluate_dimensions());
    case ExprKind::kSameBytes:
      return in_slot(node, evaluate_same_bytes());
    case ExprKind::kRecordConstant:
      return in_slot(node, evaluate_record_constant());
    case ExprKind::kTrianglePositions:
      return in_slot(node, evaluate_triangle_positions());
    case ExprKind::kClusterId:
      return in_slot(node, evaluate_cluster_id());
    case ExprKind::kQuad:  // a statement by now
      break;
  }
}

const Node* Compiler::node(const Expr* expr) {
  if (expr == nullptr) return nullptr;
  if (expr->kind == ExprKind::kVariable) return variable_node(expr->variable, expr);
  std::vector<const Node*> operands;
  for (const Expr* operand : expr->operands) operands.push_back(node(operand));
  Node& out = program_.nodes.emplace_back();
  out.expr = expr;
  out.operands = std::move(operands);
  out.bytes = bytes_of(expr->type);
  out.count = component_count(expr->type);
  compile(out);
  return &out;
}

}  // namespace kaamos::hlsl::interpret
