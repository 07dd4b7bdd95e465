// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/conversion_costs.h"

#include <algorithm>

namespace kaamos::hlsl {
namespace {

// A conversion goes from its source up to the scalar that both have in common, and from there down
// to its target. Cheapest first.
enum Step : uint8_t {
  kSplat,     // more components
  kWiden,     // up, to more bits of the same kind
  kDropSign,  // down, from unsigned
  kAddSign,   // up, to unsigned
  kNarrow,    // down, to anything else
  kConvert,   // up, to anything else
  kTruncate,  // fewer components
};

// Steps are 128 apart, because a call has fewer arguments than that.
ConversionCost cost_of(Step step) {
  return ConversionCost{1} << (2 + 7 * step);
}

constexpr int kNatives =
    static_cast<int>(Scalar::kNativeMin16Float) - static_cast<int>(Scalar::kMin16Float);

bool is_native(Scalar scalar) {
  return scalar >= Scalar::kNativeMin16Float;
}

// The min types rank alike with native 16-bit types and without.
Scalar without_size(Scalar scalar) {
  return is_native(scalar) ? static_cast<Scalar>(static_cast<int>(scalar) - kNatives) : scalar;
}

bool is_untyped(Scalar scalar) {
  return scalar == Scalar::kBool || is_literal(scalar);
}

bool is_unsigned(Scalar scalar) {
  return is_integer(scalar) && !is_signed_integer(scalar);
}

// 0 for what takes the other operand's size.
int bits_of(Scalar scalar) {
  switch (scalar) {
    case Scalar::kBool:
    case Scalar::kLiteralInt:
    case Scalar::kLiteralFloat:
      return 0;
    case Scalar::kMin10Float:
      return 10;
    case Scalar::kMin12Int:
      return 12;
    case Scalar::kMin16Float:
    case Scalar::kMin16Int:
    case Scalar::kMin16Uint:
      return 16;
    default:
      return static_cast<int>(scalar_bytes(scalar, ScalarStorage::kBuffer)) * 8;
  }
}

Scalar floating(int bits, bool min_precision) {
  if (bits == 10) return Scalar::kMin10Float;
  if (bits == 16) return min_precision ? Scalar::kMin16Float : Scalar::kFloat16;
  return bits == 64 ? Scalar::kFloat64 : Scalar::kFloat32;
}

Scalar integer(int bits, bool is_unsigned, bool min_precision) {
  if (bits == 12) return Scalar::kMin12Int;
  if (bits == 16 && min_precision) return is_unsigned ? Scalar::kMin16Uint : Scalar::kMin16Int;
  if (bits == 16) return is_unsigned ? Scalar::kUint16 : Scalar::kInt16;
  if (bits == 64) return is_unsigned ? Scalar::kUint64 : Scalar::kInt64;
  return is_unsigned ? Scalar::kUint32 : Scalar::kInt32;
}

// Returns whether a value of `from` becomes one of `to` that has more bits and is of the same kind.
// Signed and unsigned count as the same kind, unless they are min16 types.
bool is_promotion(Scalar from, Scalar to) {
  if (from == to || is_untyped(from) || is_untyped(to)) return false;
  if (is_floating(from) != is_floating(to)) return false;
  if (is_floating(from)) {
    // half without native 16-bit types ranks between a real 16-bit float and float.
    const auto order = [](Scalar scalar) {
      return scalar == Scalar::kMin10Float   ? 0
             : scalar == Scalar::kMin16Float ? 1
             : scalar == Scalar::kFloat16    ? 2
             : scalar == Scalar::kHalf       ? 3
             : scalar == Scalar::kFloat32    ? 4
                                             : 5;
    };
    return order(to) > order(from);
  }
  if (is_min_precision(to)) return from == Scalar::kMin12Int && to == Scalar::kMin16Int;
  if (bits_of(to) <= bits_of(from)) return false;
  if (!is_min_precision(from)) return true;
  return bits_of(to) >= 32 && is_unsigned(from) == is_unsigned(to);
}

// A conversion to another class, to fewer bits, or between types that nothing else connects.
bool is_cast(Scalar from, Scalar to) {
  if (from == to) return false;
  if (is_min_precision(from) || is_min_precision(to)) return true;
  if (from == Scalar::kBool || to == Scalar::kBool) return true;
  if (is_literal(from) || is_literal(to)) {
    return is_floating(from) != is_floating(to);
  }
  return is_floating(from) || is_floating(to) || bits_of(from) != bits_of(to);
}

}  // namespace

Scalar combined_scalar(Scalar a, Scalar b) {
  if (a == b) return a;
  if (is_native(a) || is_native(b)) {
    const Scalar both = combined_scalar(without_size(a), without_size(b));
    return is_min_precision(both) ? static_cast<Scalar>(static_cast<int>(both) + kNatives) : both;
  }
  const bool is_float = is_floating(a) || is_floating(b);
  if (is_literal(a) && is_literal(b)) return is_float ? Scalar::kLiteralFloat : Scalar::kLiteralInt;
  if (a == Scalar::kHalf && is_untyped(b)) return a;
  if (b == Scalar::kHalf && is_untyped(a)) return b;
  if (is_float && is_floating(a) != is_floating(b)) {
    const Scalar side = is_floating(a) ? a : b;
    return side == Scalar::kHalf || is_literal(side) ? Scalar::kFloat32 : side;
  }
  const bool one_adapts = is_untyped(a) || is_untyped(b);
  const bool min_precision = one_adapts ? is_min_precision(a) || is_min_precision(b)
                                        : is_min_precision(a) && is_min_precision(b);
  const int bits = std::max(bits_of(a), bits_of(b));
  if (is_float) return floating(bits, min_precision);
  return integer(bits, is_unsigned(a) || is_unsigned(b), min_precision);
}

ConversionCost scalar_cost(Scalar from, Scalar to) {
  from = without_size(from);
  to = without_size(to);
  const Scalar both = combined_scalar(from, to);
  ConversionCost cost = 0;
  if (is_promotion(from, both)) {
    cost += cost_of(kWiden);
  } else if (is_cast(from, both)) {
    cost += cost_of(kConvert);
  } else if (from != both && !is_literal(from)) {
    cost += cost_of(kAddSign);
  }
  if (is_cast(both, to)) {
    cost += cost_of(kNarrow);
  } else if (both != to && !is_literal(to)) {
    cost += cost_of(kDropSign);
  }
  return cost;
}

ConversionCost size_cost(uint64_t from, uint64_t to) {
  return from == to ? 0 : cost_of(from < to ? kSplat : kTruncate);
}

ConversionCost enum_cost(Scalar to) {
  return to == Scalar::kBool ? cost_of(kConvert) + cost_of(kNarrow) : cost_of(kConvert);
}

}  // namespace kaamos::hlsl
