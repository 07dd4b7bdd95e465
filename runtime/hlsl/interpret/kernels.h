// SPDX-License-Identifier: MIT
//
// The arithmetic: for each operator and intrinsic, the function that computes it from the values of
// its operands, built from the shader prelude's own functions.
#pragma once

#include <type_traits>

#include <kaamos/shader/half.h>
#include "runtime/hlsl/interpret/program.h"

namespace kaamos::hlsl::interpret {

Kernel find_unary(ir::UnaryOp op, ir::Scalar scalar);
Kernel find_binary(ir::BinaryOp op, ir::Scalar scalar);
Kernel find_select(ir::Scalar scalar);  // component by component
Kernel find_convert(ir::Scalar to, ir::Scalar from);
// Chosen by the operands' types; null for transpose, which only moves components.
Kernel find_intrinsic(const ir::Expr& expr);
Kernel find_component_intrinsic(const ir::Expr& expr);  // null: not one of these
Kernel find_shape_intrinsic(const ir::Expr& expr);      // null: not one of these
Atomic find_atomic(ir::AtomicOp op, ir::Scalar scalar);

// Calls visit(type) with a std::type_identity of the scalar's C++ type.
template <class Visit>
auto with_scalar(ir::Scalar scalar, const Visit& visit) {
  switch (scalar) {
    case ir::Scalar::kBool:
      return visit(std::type_identity<bool>{});
    case ir::Scalar::kInt16:
      return visit(std::type_identity<int16_t>{});
    case ir::Scalar::kUint16:
      return visit(std::type_identity<uint16_t>{});
    case ir::Scalar::kInt32:
      return visit(std::type_identity<int32_t>{});
    case ir::Scalar::kUint32:
      return visit(std::type_identity<uint32_t>{});
    case ir::Scalar::kInt64:
      return visit(std::type_identity<int64_t>{});
    case ir::Scalar::kUint64:
      return visit(std::type_identity<uint64_t>{});
    case ir::Scalar::kFloat16:
      return visit(std::type_identity<shader::half>{});
    case ir::Scalar::kFloat32:
      return visit(std::type_identity<float>{});
    case ir::Scalar::kFloat64:
      return visit(std::type_identity<double>{});
    default:  // Only plain ones get here.
      break;
  }
  return visit(std::type_identity<int32_t>{});
}

// Applies Op to each component; Ts are the operands' scalar types.
template <class Op, class... Ts>
struct Componentwise {
  template <size_t... I>
  static void run(const Node& node, std::byte* out, const std::byte* const* operands,
                  std::index_sequence<I...>) {
    using Result = decltype(Op::apply(Ts{}...));
    for (uint32_t i = 0; i < node.count; ++i) {
      reinterpret_cast<Result*>(out)[i] = Op::apply(reinterpret_cast<const Ts*>(operands[I])[i]...);
    }
  }
  static void kernel(const Node& node, std::byte* out, const std::byte* const* operands) {
    run(node, out, operands, std::index_sequence_for<Ts...>{});
  }
};

template <class Op, class... Ts>
constexpr Kernel componentwise() {
  return Componentwise<Op, Ts...>::kernel;
}

}  // namespace kaamos::hlsl::interpret
