// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/packed_numbers.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "runtime/hlsl/check/lower/lowerer.h"

namespace kaamos::hlsl {

namespace {

// Those that turn four numbers into the bytes of one, or back.
bool is_of_bytes(std::string_view name) {
  constexpr std::string_view kNames[] = {"pack_u8",       "pack_s8",      "pack_clamp_u8",
                                         "pack_clamp_s8", "unpack_u8u32", "unpack_s8s32",
                                         "unpack_u8u16",  "unpack_s8s16"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

}  // namespace

bool PackedNumbers::is_packed_intrinsic(std::string_view name) {
  return name == "AddUint64" || name == "dot2add" || name == "dot4add_u8packed" ||
         name == "dot4add_i8packed" || is_of_bytes(name);
}

Value PackedNumbers::call_packed(std::string_view name, std::vector<Value>& arguments,
                                 SourceLocation location) {
  const bool is_sum = name == "AddUint64";
  const size_t count = is_of_bytes(name) ? 1 : is_sum ? 2 : 3;
  if (!lower_.intrinsics.check_count(name, arguments.size(), count, count, location)) {
    return error_value();
  }
  for (size_t i = 0; i < arguments.size(); ++i) {
    const Type* type = arguments[i].type;
    if (type && (type->is_numeric() || type->is_enum())) continue;
    report(CheckId::kIntrinsicArgument, arguments[i].location,
           {std::to_string(i + 1), std::string(name), "a number or a vector",
            type ? to_string(type) : "a resource"});
    return error_value();
  }
  if (name.starts_with("pack_")) return pack_bytes(name, arguments[0], location);
  if (name.starts_with("unpack_")) return unpack_bytes(name, arguments[0], location);
  return is_sum              ? add_uint64(arguments, location)
         : name == "dot2add" ? dot_of_halves(arguments, location)
                             : dot_of_bytes(name, arguments, location);
}

// Each pair of components is the low and the high half of a number.
Value PackedNumbers::add_uint64(std::vector<Value>& arguments, SourceLocation location) {
  const Type* given = arguments[0].type;
  if (!given->is_vector() || (given->columns != 2 && given->columns != 4)) {
    report(CheckId::kIntrinsicArgument, arguments[0].location,
           {"1", "AddUint64", "uint2 or uint4", to_string(given)});
    return error_value();
  }
  const Type* type = types_.vector(Scalar::kUint32, given->columns);
  std::array<const ir::Expr*, 2> operands;
  for (size_t i = 0; i < 2; ++i) {
    const ir::Expr* operand = lower_.conversions.convert(arguments[i], type, arguments[i].location);
    if (!operand) return error_value();
    operands[i] = build_.read(body_.temporary(operand));
  }
  at(location);
  std::vector<const ir::Expr*> parts;
  for (uint8_t low = 0; low < given->columns; low = static_cast<uint8_t>(low + 2)) {
    const auto half = [&](size_t operand, uint8_t component) {
      return build_.swizzle(operands[operand], {component});
    };
    const uint8_t high = static_cast<uint8_t>(low + 1);
    const ir::Expr* sum =
        build_.read(body_.temporary(build_.binary(ir::BinaryOp::kAdd, half(0, low), half(1, low))));
    const ir::Expr* carry =
        build_.convert(build_.binary(ir::BinaryOp::kLess, sum, half(0, low)), Scalar::kUint32);
    parts.push_back(sum);
    parts.push_back(build_.binary(ir::BinaryOp::kAdd,
                                  build_.binary(ir::BinaryOp::kAdd, half(0, high), half(1, high)),
                                  carry));
  }
  return rvalue(build_.construct(type->ir, std::move(parts)), type);
}

// a.x * b.x + a.y * b.y + c in float; the products are exact.
Value PackedNumbers::dot_of_halves(std::vector<Value>& arguments, SourceLocation location) {
  if (!names_.options().native_16bit) {
    report(CheckId::kNeeds16Bit, location, {"dot2add"});
    return error_value();
  }
  const Type* half2 = types_.vector(Scalar::kFloat16, 2);
  const Type* result = types_.scalar(Scalar::kFloat32);
  std::array<const ir::Expr*, 2> operands;
  for (size_t i = 0; i < 2; ++i) {
    const ir::Expr* operand =
        lower_.conversions.convert(arguments[i], half2, arguments[i].location);
    if (!operand) return error_value();
    operands[i] = build_.read(body_.temporary(build_.convert(operand, Scalar::kFloat32)));
  }
  const ir::Expr* sum = lower_.conversions.convert(arguments[2], result, arguments[2].location);
  if (!sum) return error_value();
  at(location);
  const auto product = [&](uint8_t component) {
    return build_.binary(ir::BinaryOp::kMultiply, build_.swizzle(operands[0], {component}),
                         build_.swizzle(operands[1], {component}));
  };
  const ir::Expr* dot = build_.binary(ir::BinaryOp::kAdd, product(0), product(1));
  return rvalue(build_.binary(ir::BinaryOp::kAdd, dot, sum), result);
}

// The sum of four products of bytes, and the accumulator.
Value PackedNumbers::dot_of_bytes(std::string_view name, std::vector<Value>& arguments,
                                  SourceLocation location) {
  const bool is_signed = name == "dot4add_i8packed";
  const Type* packed = types_.scalar(Scalar::kUint32);
  const Type* result = types_.scalar(is_signed ? Scalar::kInt32 : Scalar::kUint32);
  std::array<const ir::Expr*, 2> operands;
  for (size_t i = 0; i < 2; ++i) {
    const ir::Expr* operand =
        lower_.conversions.convert(arguments[i], packed, arguments[i].location);
    if (!operand) return error_value();
    operands[i] = build_.read(body_.temporary(build_.convert(operand, result->ir->scalar)));
  }
  const ir::Expr* sum = lower_.conversions.convert(arguments[2], result, arguments[2].location);
  if (!sum) return error_value();
  at(location);
  const auto number = [&](uint64_t value) {
    return is_signed ? build_.int32(static_cast<int64_t>(value)) : build_.uint32(value);
  };
  // An arithmetic shift to the right extends the sign.
  const auto byte = [&](size_t operand, uint64_t i) {
    const ir::Expr* top =
        build_.binary(ir::BinaryOp::kShiftLeft, operands[operand], number(24 - 8 * i));
    return build_.binary(ir::BinaryOp::kShiftRight, top, number(24));
  };
  for (uint64_t i = 0; i < 4; ++i) {
    sum = build_.binary(ir::BinaryOp::kAdd, sum,
                        build_.binary(ir::BinaryOp::kMultiply, byte(0, i), byte(1, i)));
  }
  return rvalue(sum, result);
}

// pack_u8 and pack_s8 take the low bytes; pack_clamp_u8 and pack_clamp_s8 the nearest number that a
// byte has. The first component is the lowest byte. [HLSL SM 6.6 Pack/Unpack]
Value PackedNumbers::pack_bytes(std::string_view name, const Value& argument,
                                SourceLocation location) {
  const Type* four = types_.vector(name == "pack_u8" ? Scalar::kUint32 : Scalar::kInt32, 4);
  const ir::Expr* numbers = lower_.conversions.convert(argument, four, argument.location);
  if (!numbers) return error_value();
  at(location);
  if (name.starts_with("pack_clamp")) {
    const bool is_signed = name.ends_with("s8");
    const auto limit = [&](int64_t value) { return build_.splat(build_.int32(value), four->ir); };
    numbers =
        build_.intrinsic(Intrinsic::clamp, four->ir,
                         {numbers, limit(is_signed ? -128 : 0), limit(is_signed ? 127 : 255)});
  }
  numbers = build_.read(body_.temporary(build_.convert(numbers, Scalar::kUint32)));
  const ir::Expr* packed = nullptr;
  for (uint8_t i = 0; i < 4; ++i) {
    const ir::Expr* byte =
        build_.binary(ir::BinaryOp::kBitAnd, build_.swizzle(numbers, {i}), build_.uint32(0xFF));
    const ir::Expr* part = build_.binary(ir::BinaryOp::kShiftLeft, byte, build_.uint32(8u * i));
    packed = packed ? build_.binary(ir::BinaryOp::kBitOr, packed, part) : byte;
  }
  return rvalue(packed, types_.scalar(Scalar::kUint32));
}

Value PackedNumbers::unpack_bytes(std::string_view name, const Value& argument,
                                  SourceLocation location) {
  const bool is_signed = name.starts_with("unpack_s8");
  const Scalar wide = is_signed ? Scalar::kInt32 : Scalar::kUint32;
  const ir::Expr* packed =
      lower_.conversions.convert(argument, types_.scalar(Scalar::kUint32), argument.location);
  if (!packed) return error_value();
  at(location);
  packed = build_.read(body_.temporary(build_.convert(packed, wide)));
  const auto number = [&](uint64_t value) {
    return is_signed ? build_.int32(static_cast<int64_t>(value)) : build_.uint32(value);
  };
  std::vector<const ir::Expr*> bytes;
  for (uint64_t i = 0; i < 4; ++i) {
    // An arithmetic shift to the right extends the sign.
    const ir::Expr* top = build_.binary(ir::BinaryOp::kShiftLeft, packed, number(24 - 8 * i));
    bytes.push_back(build_.binary(ir::BinaryOp::kShiftRight, top, number(24)));
  }
  const ir::Expr* four = build_.construct(types_.vector(wide, 4)->ir, std::move(bytes));
  if (!name.ends_with("16")) return rvalue(four, types_.vector(wide, 4));
  Scalar narrow = is_signed ? Scalar::kInt16 : Scalar::kUint16;
  if (!names_.options().native_16bit) {
    narrow = is_signed ? Scalar::kMin16Int : Scalar::kMin16Uint;
  }
  const Type* type = types_.vector(narrow, 4);
  return rvalue(build_.convert(four, type->ir->scalar), type);
}

}  // namespace kaamos::hlsl
