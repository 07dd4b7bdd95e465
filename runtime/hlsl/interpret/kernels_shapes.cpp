// SPDX-License-Identifier: MIT
//
// Intrinsics whose result depends on the shape of their operands: geometry, mul(), any(), all().
#include <kaamos/shader/prelude.h>

#include "runtime/hlsl/interpret/kernels.h"

namespace kaamos::hlsl::interpret {

using ir::Scalar;
using ir::Type;
using ir::TypeKind;
using shader::mat;
using shader::vec;

namespace {

template <class T>
const T& as(const std::byte* bytes) {
  return *reinterpret_cast<const T*>(bytes);
}
template <class T>
void put(std::byte* out, const T& value) {
  *reinterpret_cast<T*>(out) = value;
}

template <class T>
void any_kernel(const Node& node, std::byte* out, const std::byte* const* operands) {
  bool result = false;
  for (uint32_t i = 0; i < node.count; ++i) result |= shader::any((&as<T>(operands[0]))[i]);
  put(out, result);
}
template <class T>
void all_kernel(const Node& node, std::byte* out, const std::byte* const* operands) {
  bool result = true;
  for (uint32_t i = 0; i < node.count; ++i) result &= shader::all((&as<T>(operands[0]))[i]);
  put(out, result);
}

// Rows times columns; sums are in the same order as in dot_sum().
template <class T>
void product_kernel(const Node& node, std::byte* out, const std::byte* const* operands) {
  using shader::op::Add;
  using shader::op::Multiply;
  using shader::op::widen;
  const T* left = &as<T>(operands[0]);
  const T* right = &as<T>(operands[1]);
  for (uint32_t r = 0; r < node.rows; ++r) {
    for (uint32_t c = 0; c < node.columns; ++c) {
      const T* row = left + r * node.inner;
      auto sum = Multiply::apply(widen(row[0]), widen(right[c]));
      for (uint32_t k = 1; k < node.inner; ++k) {
        sum = Add::apply(sum, Multiply::apply(widen(row[k]), widen(right[k * node.columns + c])));
      }
      put(out + (r * node.columns + c) * sizeof(T), shader::op::Convert<T>::apply(sum));
    }
  }
}
// A scalar times anything; node.inner says which operand is the scalar.
template <class T>
void scale_kernel(const Node& node, std::byte* out, const std::byte* const* operands) {
  const T scalar = as<T>(operands[node.inner]);
  const T* other = &as<T>(operands[1 - node.inner]);
  for (uint32_t i = 0; i < node.count; ++i) {
    put(out + i * sizeof(T), shader::op::Multiply::apply(other[i], scalar));
  }
}

template <class V>
void length_kernel(const Node&, std::byte* out, const std::byte* const* operands) {
  put(out, shader::length(as<V>(operands[0])));
}
template <class V>
void distance_kernel(const Node&, std::byte* out, const std::byte* const* operands) {
  put(out, shader::distance(as<V>(operands[0]), as<V>(operands[1])));
}
template <class V>
void normalize_kernel(const Node&, std::byte* out, const std::byte* const* operands) {
  put(out, shader::normalize(as<V>(operands[0])));
}
template <class V>
void reflect_kernel(const Node&, std::byte* out, const std::byte* const* operands) {
  put(out, shader::reflect(as<V>(operands[0]), as<V>(operands[1])));
}
template <class V>
void refract_kernel(const Node&, std::byte* out, const std::byte* const* operands) {
  using T = shader::scalar_of<V>;
  put(out, shader::refract(as<V>(operands[0]), as<V>(operands[1]), as<T>(operands[2])));
}
template <class V>
void faceforward_kernel(const Node&, std::byte* out, const std::byte* const* operands) {
  put(out, shader::faceforward(as<V>(operands[0]), as<V>(operands[1]), as<V>(operands[2])));
}
template <class V>
void dot_kernel(const Node&, std::byte* out, const std::byte* const* operands) {
  put(out, shader::dot(as<V>(operands[0]), as<V>(operands[1])));
}

template <class V>
Kernel vector_kernel(Intrinsic intrinsic) {
  switch (intrinsic) {
    case Intrinsic::length:
      return length_kernel<V>;
    case Intrinsic::distance:
      return distance_kernel<V>;
    case Intrinsic::normalize:
      return normalize_kernel<V>;
    case Intrinsic::reflect:
      return reflect_kernel<V>;
    case Intrinsic::refract:
      return refract_kernel<V>;
    case Intrinsic::faceforward:
      return faceforward_kernel<V>;
    default:
      return nullptr;
  }
}

template <class T>
Kernel determinant_kernel(uint8_t size) {
  const auto of_size = [](auto n) -> Kernel {
    return [](const Node&, std::byte* out, const std::byte* const* operands) {
      constexpr int kSize = decltype(n)::value;
      put(out, shader::determinant(as<mat<T, kSize, kSize>>(operands[0])));
    };
  };
  switch (size) {
    case 1:
      return of_size(std::integral_constant<int, 1>{});
    case 2:
      return of_size(std::integral_constant<int, 2>{});
    case 3:
      return of_size(std::integral_constant<int, 3>{});
    default:
      return of_size(std::integral_constant<int, 4>{});
  }
}

template <class T>
void cross_kernel(const Node&, std::byte* out, const std::byte* const* operands) {
  put(out, shader::cross(as<vec<T, 3>>(operands[0]), as<vec<T, 3>>(operands[1])));
}
template <class T>
void lit_kernel(const Node&, std::byte* out, const std::byte* const* operands) {
  put(out, shader::lit(as<T>(operands[0]), as<T>(operands[1]), as<T>(operands[2])));
}
template <class T>
void dst_kernel(const Node&, std::byte* out, const std::byte* const* operands) {
  put(out, shader::dst(as<vec<T, 4>>(operands[0]), as<vec<T, 4>>(operands[1])));
}
void msad4_kernel(const Node&, std::byte* out, const std::byte* const* operands) {
  put(out, shader::msad4(as<uint32_t>(operands[0]), as<shader::uint2>(operands[1]),
                         as<shader::uint4>(operands[2])));
}

template <class T, class Visit>
Kernel with_shape(const Type* type, const Visit& visit) {
  if (type->kind == TypeKind::kScalar) return visit(std::type_identity<T>{});
  switch (type->columns) {
    case 1:
      return visit(std::type_identity<vec<T, 1>>{});
    case 2:
      return visit(std::type_identity<vec<T, 2>>{});
    case 3:
      return visit(std::type_identity<vec<T, 3>>{});
    default:
      return visit(std::type_identity<vec<T, 4>>{});
  }
}

template <class T>
Kernel float_kernel(const ir::Expr& expr) {
  const Type* type = expr.operands[0]->type;
  switch (expr.intrinsic) {
    case Intrinsic::cross:
      return cross_kernel<T>;
    case Intrinsic::determinant:
      return determinant_kernel<T>(type->columns);
    case Intrinsic::dst:
      return dst_kernel<T>;
    case Intrinsic::lit:
      return lit_kernel<T>;
    default:
      return with_shape<T>(type, [&](auto shape) {
        return vector_kernel<typename decltype(shape)::type>(expr.intrinsic);
      });
  }
}

template <class T>
Kernel number_kernel(const ir::Expr& expr) {
  if constexpr (std::is_same_v<T, bool>) {
    return nullptr;
  } else {
    const Type* type = expr.operands[0]->type;
    if (expr.intrinsic == Intrinsic::dot) {
      return with_shape<T>(
          type, [](auto shape) -> Kernel { return dot_kernel<typename decltype(shape)::type>; });
    }
    const bool scales =
        type->kind == TypeKind::kScalar || expr.operands[1]->type->kind == TypeKind::kScalar;
    return scales ? scale_kernel<T> : product_kernel<T>;
  }
}

}  // namespace

Kernel find_shape_intrinsic(const ir::Expr& expr) {
  const Scalar scalar = expr.operands[0]->type->scalar;
  switch (expr.intrinsic) {
    case Intrinsic::any:
      return with_scalar(
          scalar, [](auto type) -> Kernel { return any_kernel<typename decltype(type)::type>; });
    case Intrinsic::all:
      return with_scalar(
          scalar, [](auto type) -> Kernel { return all_kernel<typename decltype(type)::type>; });
    case Intrinsic::mul:
    case Intrinsic::dot:
      return with_scalar(
          scalar, [&](auto type) { return number_kernel<typename decltype(type)::type>(expr); });
    case Intrinsic::msad4:
      return msad4_kernel;
    default:
      break;
  }
  switch (scalar) {
    case Scalar::kFloat16:
      return float_kernel<shader::half>(expr);
    case Scalar::kFloat64:
      return float_kernel<double>(expr);
    case Scalar::kFloat32:
      return float_kernel<float>(expr);
    default:
      return nullptr;
  }
}

Kernel find_intrinsic(const ir::Expr& expr) {
  const Kernel kernel = find_component_intrinsic(expr);
  return kernel != nullptr ? kernel : find_shape_intrinsic(expr);
}

}  // namespace kaamos::hlsl::interpret
