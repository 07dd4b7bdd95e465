// SPDX-License-Identifier: MIT
//
// The scalar types of HLSL, for everything from the checker to the executors.
// shader::WaveScalar, which emitted code includes, has the numbers of the first ten.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "kaamos/shader/wave_op.h"

namespace kaamos::hlsl {

// The intermediate representation has the first ten only, the plain ones. Of the others, which the
// checker replaces, a literal type adapts to what it is used with; its values are held as 64-bit
// integers and doubles. half and the min types have 32 bits, or 16 with native 16-bit types; they
// are types of their own for overloads and templates.
enum class Scalar : uint8_t {
  kBool,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat16,
  kFloat32,
  kFloat64,
  kLiteralInt,
  kLiteralFloat,
  kHalf,  // Without native 16-bit types; with them half is kFloat16.
  kMin16Float,
  kMin10Float,
  kMin16Int,
  kMin12Int,
  kMin16Uint,
  kNativeMin16Float,  // With native 16-bit types, from here on.
  kNativeMin10Float,
  kNativeMin16Int,
  kNativeMin12Int,
  kNativeMin16Uint,
};

constexpr bool is_plain(Scalar scalar) {
  return scalar <= Scalar::kFloat64;
}
constexpr bool is_floating(Scalar scalar) {
  return scalar == Scalar::kFloat16 || scalar == Scalar::kFloat32 || scalar == Scalar::kFloat64 ||
         scalar == Scalar::kLiteralFloat || scalar == Scalar::kHalf ||
         scalar == Scalar::kMin16Float || scalar == Scalar::kMin10Float ||
         scalar == Scalar::kNativeMin16Float || scalar == Scalar::kNativeMin10Float;
}
constexpr bool is_literal(Scalar scalar) {
  return scalar == Scalar::kLiteralInt || scalar == Scalar::kLiteralFloat;
}
constexpr bool is_signed_integer(Scalar scalar) {
  return scalar == Scalar::kInt16 || scalar == Scalar::kInt32 || scalar == Scalar::kInt64 ||
         scalar == Scalar::kLiteralInt || scalar == Scalar::kMin16Int ||
         scalar == Scalar::kMin12Int || scalar == Scalar::kNativeMin16Int ||
         scalar == Scalar::kNativeMin12Int;
}
constexpr bool is_min_precision(Scalar scalar) {
  return scalar >= Scalar::kMin16Float;
}
constexpr bool is_integer(Scalar scalar) {
  return !is_floating(scalar) && scalar != Scalar::kBool;
}

// The plain type whose values it has: float for half.
constexpr Scalar plain_scalar(Scalar scalar) {
  switch (scalar) {
    case Scalar::kLiteralInt:
      return Scalar::kInt64;
    case Scalar::kLiteralFloat:
      return Scalar::kFloat64;
    case Scalar::kHalf:
    case Scalar::kMin16Float:
    case Scalar::kMin10Float:
      return Scalar::kFloat32;
    case Scalar::kMin16Int:
    case Scalar::kMin12Int:
      return Scalar::kInt32;
    case Scalar::kMin16Uint:
      return Scalar::kUint32;
    case Scalar::kNativeMin16Float:
    case Scalar::kNativeMin10Float:
      return Scalar::kFloat16;
    case Scalar::kNativeMin16Int:
    case Scalar::kNativeMin12Int:
      return Scalar::kInt16;
    case Scalar::kNativeMin16Uint:
      return Scalar::kUint16;
    default:
      return scalar;
  }
}

// The place of a scalar: a bool is a byte in a variable, as in C++, and takes four in a buffer.
// Literal types count as int and float.
enum class ScalarStorage : uint8_t { kVariable, kBuffer };

constexpr uint32_t scalar_bytes(Scalar scalar, ScalarStorage storage) {
  switch (scalar) {
    case Scalar::kBool:
      return storage == ScalarStorage::kVariable ? 1 : 4;
    case Scalar::kInt16:
    case Scalar::kUint16:
    case Scalar::kFloat16:
    case Scalar::kNativeMin16Float:
    case Scalar::kNativeMin10Float:
    case Scalar::kNativeMin16Int:
    case Scalar::kNativeMin12Int:
    case Scalar::kNativeMin16Uint:
      return 2;
    case Scalar::kInt64:
    case Scalar::kUint64:
    case Scalar::kFloat64:
      return 8;
    default:
      return 4;
  }
}

// As written in HLSL.
constexpr std::string_view name_of(Scalar scalar) {
  constexpr std::string_view kNames[] = {
      "bool",       "int16_t",    "uint16_t",   "int",      "uint",        "int64_t",
      "uint64_t",   "float16_t",  "float",      "double",   "literal int", "literal float",
      "half",       "min16float", "min10float", "min16int", "min12int",    "min16uint",
      "min16float", "min10float", "min16int",   "min12int", "min16uint"};
  return kNames[static_cast<size_t>(scalar)];
}

// Converts to the type that a wave operation is told, and back.
constexpr shader::WaveScalar wave_scalar(Scalar plain) {
  return static_cast<shader::WaveScalar>(plain);
}
constexpr Scalar scalar_of(shader::WaveScalar scalar) {
  return static_cast<Scalar>(scalar);
}
static_assert(wave_scalar(Scalar::kBool) == shader::WaveScalar::kBool);
static_assert(wave_scalar(Scalar::kInt16) == shader::WaveScalar::kInt16);
static_assert(wave_scalar(Scalar::kUint16) == shader::WaveScalar::kUint16);
static_assert(wave_scalar(Scalar::kInt32) == shader::WaveScalar::kInt32);
static_assert(wave_scalar(Scalar::kUint32) == shader::WaveScalar::kUint32);
static_assert(wave_scalar(Scalar::kInt64) == shader::WaveScalar::kInt64);
static_assert(wave_scalar(Scalar::kUint64) == shader::WaveScalar::kUint64);
static_assert(wave_scalar(Scalar::kFloat16) == shader::WaveScalar::kFloat16);
static_assert(wave_scalar(Scalar::kFloat32) == shader::WaveScalar::kFloat32);
static_assert(wave_scalar(Scalar::kFloat64) == shader::WaveScalar::kFloat64);

namespace ir {
using hlsl::Scalar;
}

}  // namespace kaamos::hlsl
