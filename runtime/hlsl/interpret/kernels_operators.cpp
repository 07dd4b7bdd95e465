// SPDX-License-Identifier: MIT
//
// Operators, conversions and atomics.
#include <kaamos/shader/prelude.h>

#include <utility>

#include "runtime/hlsl/interpret/kernels.h"

namespace kaamos::hlsl::interpret {

using ir::AtomicOp;
using ir::BinaryOp;
using ir::Scalar;
using ir::UnaryOp;
namespace op = shader::op;

namespace {

template <class Op, class T>
constexpr Kernel arithmetic() {
  if constexpr (std::is_same_v<T, bool>) {
    return nullptr;
  } else {
    return componentwise<Op, T, T>();
  }
}
template <class Op, class T>
constexpr Kernel comparison() {
  return componentwise<Op, T, T>();
}
template <class Op, class T>
constexpr Kernel bitwise() {
  if constexpr (shader::is_float<T>) {
    return nullptr;
  } else {
    return componentwise<Op, T, T>();
  }
}
template <class Op, class T>
constexpr Kernel shift() {
  if constexpr (shader::is_integer<T>) {
    return componentwise<Op, T, T>();
  } else {
    return nullptr;
  }
}

template <class T>
Kernel binary_kernel(BinaryOp which) {
  switch (which) {
    case BinaryOp::kAdd:
      return arithmetic<op::Add, T>();
    case BinaryOp::kSubtract:
      return arithmetic<op::Subtract, T>();
    case BinaryOp::kMultiply:
      return arithmetic<op::Multiply, T>();
    case BinaryOp::kDivide:
      return arithmetic<op::Divide, T>();
    case BinaryOp::kModulo:
      return arithmetic<op::Modulo, T>();
    case BinaryOp::kBitAnd:
      return bitwise<op::BitAnd, T>();
    case BinaryOp::kBitOr:
      return bitwise<op::BitOr, T>();
    case BinaryOp::kBitXor:
      return bitwise<op::BitXor, T>();
    case BinaryOp::kShiftLeft:
      return shift<op::ShiftLeft, T>();
    case BinaryOp::kShiftRight:
      return shift<op::ShiftRight, T>();
    case BinaryOp::kLess:
      return comparison<op::Less, T>();
    case BinaryOp::kLessEqual:
      return comparison<op::LessEqual, T>();
    case BinaryOp::kGreater:
      return comparison<op::Greater, T>();
    case BinaryOp::kGreaterEqual:
      return comparison<op::GreaterEqual, T>();
    case BinaryOp::kEqual:
      return comparison<op::Equal, T>();
    case BinaryOp::kNotEqual:
      return comparison<op::NotEqual, T>();
  }
  return nullptr;
}

template <class T>
Kernel unary_kernel(UnaryOp which) {
  switch (which) {
    case UnaryOp::kNegate:
      return componentwise<op::Negate, T>();
    case UnaryOp::kNot:
      return componentwise<op::LogicalNot, T>();
    case UnaryOp::kBitNot:
      if constexpr (shader::is_float<T>) {
        return nullptr;
      } else {
        return componentwise<op::BitNot, T>();
      }
  }
  return nullptr;
}

template <class T>
void put(std::byte* result, T value) {
  if (result != nullptr) __builtin_memcpy(result, &value, sizeof(value));
}

template <class T, T (*Function)(T*, std::type_identity_t<T>)>
void apply_atomic(void* place, const std::byte*, const std::byte* value, std::byte* result) {
  put(result, Function(static_cast<T*>(place), read_as<T>(value)));
}
template <class T>
void exchange(void* place, const std::byte*, const std::byte* value, std::byte* result) {
  put(result, shader::interlocked_exchange(static_cast<T*>(place), read_as<T>(value)));
}
template <class T>
void compare_exchange(void* place, const std::byte* compare, const std::byte* value,
                      std::byte* result) {
  put(result, shader::interlocked_compare_exchange(static_cast<T*>(place), read_as<T>(compare),
                                                   read_as<T>(value)));
}

template <class T>
Atomic atomic_of(AtomicOp which) {
  if (which == AtomicOp::kExchange) return exchange<T>;
  if (which == AtomicOp::kCompareExchange || which == AtomicOp::kCompareStore) {
    return compare_exchange<T>;
  }
  if constexpr (std::is_integral_v<T>) {
    switch (which) {
      case AtomicOp::kAdd:
        return apply_atomic<T, shader::interlocked_add<T>>;
      case AtomicOp::kAnd:
        return apply_atomic<T, shader::interlocked_and<T>>;
      case AtomicOp::kOr:
        return apply_atomic<T, shader::interlocked_or<T>>;
      case AtomicOp::kXor:
        return apply_atomic<T, shader::interlocked_xor<T>>;
      case AtomicOp::kMin:
        return apply_atomic<T, shader::interlocked_min<T>>;
      case AtomicOp::kMax:
        return apply_atomic<T, shader::interlocked_max<T>>;
      default:
        break;
    }
  }
  return nullptr;
}

}  // namespace

Kernel find_unary(UnaryOp which, Scalar scalar) {
  return with_scalar(
      scalar, [which](auto type) { return unary_kernel<typename decltype(type)::type>(which); });
}

Kernel find_binary(BinaryOp which, Scalar scalar) {
  return with_scalar(
      scalar, [which](auto type) { return binary_kernel<typename decltype(type)::type>(which); });
}

Kernel find_select(Scalar scalar) {
  return with_scalar(scalar, [](auto type) {
    using T = typename decltype(type)::type;
    return componentwise<op::Select, bool, T, T>();
  });
}

Kernel find_convert(Scalar to, Scalar from) {
  return with_scalar(to, [from](auto target) {
    return with_scalar(from, [](auto source) {
      return componentwise<op::Convert<typename decltype(target)::type>,
                           typename decltype(source)::type>();
    });
  });
}

Atomic find_atomic(AtomicOp which, Scalar scalar) {
  switch (scalar) {
    case Scalar::kInt32:
      return atomic_of<int32_t>(which);
    case Scalar::kInt64:
      return atomic_of<int64_t>(which);
    case Scalar::kUint64:
      return atomic_of<uint64_t>(which);
    case Scalar::kFloat32:
      return atomic_of<float>(which);
    default:
      return atomic_of<uint32_t>(which);
  }
}

}  // namespace kaamos::hlsl::interpret
