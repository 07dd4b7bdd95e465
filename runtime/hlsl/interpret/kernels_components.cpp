// SPDX-License-Identifier: MIT
//
// Intrinsics that work component by component.
#include <kaamos/shader/prelude.h>

#include <utility>

#include "runtime/hlsl/interpret/kernels.h"

namespace kaamos::hlsl::interpret {

using ir::Scalar;

namespace {

// Wraps a prelude function in a type that a kernel can be instantiated with.
#define KAAMOS_INTRINSIC(name)   \
  struct name##_op {             \
    template <class... T>        \
    static auto apply(T... x) {  \
      return shader::name(x...); \
    }                            \
  };
KAAMOS_INTRINSIC(abs)
KAAMOS_INTRINSIC(acos)
KAAMOS_INTRINSIC(asdouble)
KAAMOS_INTRINSIC(asfloat)
KAAMOS_INTRINSIC(asfloat16)
KAAMOS_INTRINSIC(asin)
KAAMOS_INTRINSIC(asint)
KAAMOS_INTRINSIC(asint16)
KAAMOS_INTRINSIC(asuint)
KAAMOS_INTRINSIC(asuint16)
KAAMOS_INTRINSIC(asuint_high)
KAAMOS_INTRINSIC(asuint_low)
KAAMOS_INTRINSIC(atan)
KAAMOS_INTRINSIC(atan2)
KAAMOS_INTRINSIC(ceil)
KAAMOS_INTRINSIC(clamp)
KAAMOS_INTRINSIC(cos)
KAAMOS_INTRINSIC(cosh)
KAAMOS_INTRINSIC(countbits)
KAAMOS_INTRINSIC(degrees)
KAAMOS_INTRINSIC(exp)
KAAMOS_INTRINSIC(exp2)
KAAMOS_INTRINSIC(f16tof32)
KAAMOS_INTRINSIC(f32tof16)
KAAMOS_INTRINSIC(firstbithigh)
KAAMOS_INTRINSIC(firstbitlow)
KAAMOS_INTRINSIC(floor)
KAAMOS_INTRINSIC(fma)
KAAMOS_INTRINSIC(fmod)
KAAMOS_INTRINSIC(frac)
KAAMOS_INTRINSIC(frexp_exponent)
KAAMOS_INTRINSIC(frexp_mantissa)
KAAMOS_INTRINSIC(isfinite)
KAAMOS_INTRINSIC(isinf)
KAAMOS_INTRINSIC(isnan)
KAAMOS_INTRINSIC(isnormal)
KAAMOS_INTRINSIC(ldexp)
KAAMOS_INTRINSIC(lerp)
KAAMOS_INTRINSIC(log)
KAAMOS_INTRINSIC(log10)
KAAMOS_INTRINSIC(log2)
KAAMOS_INTRINSIC(mad)
KAAMOS_INTRINSIC(max)
KAAMOS_INTRINSIC(min)
KAAMOS_INTRINSIC(modf_fraction)
KAAMOS_INTRINSIC(modf_integer)
KAAMOS_INTRINSIC(pow)
KAAMOS_INTRINSIC(radians)
KAAMOS_INTRINSIC(rcp)
KAAMOS_INTRINSIC(reversebits)
KAAMOS_INTRINSIC(round)
KAAMOS_INTRINSIC(rsqrt)
KAAMOS_INTRINSIC(saturate)
KAAMOS_INTRINSIC(sign)
KAAMOS_INTRINSIC(sin)
KAAMOS_INTRINSIC(sinh)
KAAMOS_INTRINSIC(smoothstep)
KAAMOS_INTRINSIC(sqrt)
KAAMOS_INTRINSIC(step)
KAAMOS_INTRINSIC(tan)
KAAMOS_INTRINSIC(tanh)
KAAMOS_INTRINSIC(trunc)
#undef KAAMOS_INTRINSIC

template <class Op, class T, size_t... I>
constexpr Kernel repeat(std::index_sequence<I...>) {
  return componentwise<Op, std::conditional_t<I + 1 != 0, T, void>...>();
}
// N operands of the same type.
template <class Op, size_t N, class T>
constexpr Kernel same() {
  return repeat<Op, T>(std::make_index_sequence<N>{});
}

template <class Op, size_t N = 1>
Kernel floats(Scalar scalar) {
  switch (scalar) {
    case Scalar::kFloat16:
      return same<Op, N, shader::half>();
    case Scalar::kFloat64:
      return same<Op, N, double>();
    case Scalar::kFloat32:
      return same<Op, N, float>();
    default:
      return nullptr;
  }
}

template <class Op, size_t N = 1>
Kernel integers(Scalar scalar) {
  switch (scalar) {
    case Scalar::kInt16:
      return same<Op, N, int16_t>();
    case Scalar::kUint16:
      return same<Op, N, uint16_t>();
    case Scalar::kInt32:
      return same<Op, N, int32_t>();
    case Scalar::kUint32:
      return same<Op, N, uint32_t>();
    case Scalar::kInt64:
      return same<Op, N, int64_t>();
    case Scalar::kUint64:
      return same<Op, N, uint64_t>();
    default:
      return nullptr;
  }
}

template <class Op, size_t N = 1>
Kernel numbers(Scalar scalar) {
  const Kernel kernel = floats<Op, N>(scalar);
  return kernel != nullptr ? kernel : integers<Op, N>(scalar);
}

template <class Op>
Kernel words(Scalar scalar) {
  switch (scalar) {
    case Scalar::kFloat32:
      return same<Op, 1, float>();
    case Scalar::kInt32:
      return same<Op, 1, int32_t>();
    default:
      return same<Op, 1, uint32_t>();
  }
}

template <class Op>
Kernel half_words(Scalar scalar) {
  switch (scalar) {
    case Scalar::kFloat16:
      return same<Op, 1, shader::half>();
    case Scalar::kInt16:
      return same<Op, 1, int16_t>();
    default:
      return same<Op, 1, uint16_t>();
  }
}

}  // namespace

Kernel find_component_intrinsic(const ir::Expr& expr) {
  const Scalar s = expr.operands[0]->type->scalar;
  // clang-format off
  switch (expr.intrinsic) {
    case Intrinsic::abs: return numbers<abs_op>(s);
    case Intrinsic::acos: return floats<acos_op>(s);
    case Intrinsic::asdouble: return same<asdouble_op, 2, uint32_t>();
    case Intrinsic::asfloat: return words<asfloat_op>(s);
    case Intrinsic::asfloat16: return half_words<asfloat16_op>(s);
    case Intrinsic::asin: return floats<asin_op>(s);
    case Intrinsic::asint: return words<asint_op>(s);
    case Intrinsic::asint16: return half_words<asint16_op>(s);
    case Intrinsic::asuint: return words<asuint_op>(s);
    case Intrinsic::asuint16: return half_words<asuint16_op>(s);
    case Intrinsic::asuint_high: return same<asuint_high_op, 1, double>();
    case Intrinsic::asuint_low: return same<asuint_low_op, 1, double>();
    case Intrinsic::atan: return floats<atan_op>(s);
    case Intrinsic::atan2: return floats<atan2_op, 2>(s);
    case Intrinsic::ceil: return floats<ceil_op>(s);
    case Intrinsic::clamp: return numbers<clamp_op, 3>(s);
    case Intrinsic::cos: return floats<cos_op>(s);
    case Intrinsic::cosh: return floats<cosh_op>(s);
    case Intrinsic::countbits: return integers<countbits_op>(s);
    case Intrinsic::degrees: return floats<degrees_op>(s);
    case Intrinsic::exp: return floats<exp_op>(s);
    case Intrinsic::exp2: return floats<exp2_op>(s);
    case Intrinsic::f16tof32: return same<f16tof32_op, 1, uint32_t>();
    case Intrinsic::f32tof16: return same<f32tof16_op, 1, float>();
    case Intrinsic::firstbithigh: return integers<firstbithigh_op>(s);
    case Intrinsic::firstbitlow: return integers<firstbitlow_op>(s);
    case Intrinsic::floor: return floats<floor_op>(s);
    case Intrinsic::fma: return floats<fma_op, 3>(s);
    case Intrinsic::fmod: return floats<fmod_op, 2>(s);
    case Intrinsic::frac: return floats<frac_op>(s);
    case Intrinsic::frexp_exponent: return floats<frexp_exponent_op>(s);
    case Intrinsic::frexp_mantissa: return floats<frexp_mantissa_op>(s);
    case Intrinsic::isfinite: return floats<isfinite_op>(s);
    case Intrinsic::isinf: return floats<isinf_op>(s);
    case Intrinsic::isnan: return floats<isnan_op>(s);
    case Intrinsic::isnormal: return floats<isnormal_op>(s);
    case Intrinsic::ldexp: return floats<ldexp_op, 2>(s);
    case Intrinsic::lerp: return floats<lerp_op, 3>(s);
    case Intrinsic::log: return floats<log_op>(s);
    case Intrinsic::log10: return floats<log10_op>(s);
    case Intrinsic::log2: return floats<log2_op>(s);
    case Intrinsic::mad: return numbers<mad_op, 3>(s);
    case Intrinsic::max: return numbers<max_op, 2>(s);
    case Intrinsic::min: return numbers<min_op, 2>(s);
    case Intrinsic::modf_fraction: return numbers<modf_fraction_op>(s);
    case Intrinsic::modf_integer: return numbers<modf_integer_op>(s);
    case Intrinsic::pow: return floats<pow_op, 2>(s);
    case Intrinsic::radians: return floats<radians_op>(s);
    case Intrinsic::rcp: return floats<rcp_op>(s);
    case Intrinsic::reversebits: return integers<reversebits_op>(s);
    case Intrinsic::round: return floats<round_op>(s);
    case Intrinsic::rsqrt: return floats<rsqrt_op>(s);
    case Intrinsic::saturate: return floats<saturate_op>(s);
    case Intrinsic::sign: return numbers<sign_op>(s);
    case Intrinsic::sin: return floats<sin_op>(s);
    case Intrinsic::sinh: return floats<sinh_op>(s);
    case Intrinsic::smoothstep: return floats<smoothstep_op, 3>(s);
    case Intrinsic::sqrt: return floats<sqrt_op>(s);
    case Intrinsic::step: return floats<step_op, 2>(s);
    case Intrinsic::tan: return floats<tan_op>(s);
    case Intrinsic::tanh: return floats<tanh_op>(s);
    case Intrinsic::trunc: return floats<trunc_op>(s);
    default: return nullptr;
  }
  // clang-format on
}

}  // namespace kaamos::hlsl::interpret
