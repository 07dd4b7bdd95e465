// SPDX-License-Identifier: MIT
// Components of 64 bits in texels, where each is two of 32 bits: the low half, then the high half.
// [HLSL: Shader Model 6.6, 64-bit atomics on typed resources]
#include "runtime/hlsl/check/checker.h"

namespace kaamos::hlsl {

const ir::Expr* Lowerer::from_texel(const ir::Expr* raw, const Type* type) {
  if (!has_paired_texel(type)) return raw;
  const ir::Expr* halves = build_.read(temporary(raw));
  std::vector<const ir::Expr*> parts;
  for (uint8_t i = 0; i < type->components(); ++i) {
    const auto half = [&](int which) {
      const ir::Expr* part = build_.swizzle(halves, {static_cast<uint8_t>(2 * i + which)});
      return build_.convert(part, Scalar::kUint32);
    };
    if (type->scalar == Scalar::kFloat64) {
      parts.push_back(build_.intrinsic(Intrinsic::asdouble, build_.scalar_type(Scalar::kFloat64),
                                       {half(0), half(1)}));
      continue;
    }
    const ir::Type* wide = build_.scalar_type(Scalar::kUint64);
    const ir::Expr* high =
        build_.binary(ir::BinaryOp::kShiftLeft, build_.convert(half(1), Scalar::kUint64),
                      build_.literal(wide, {32}));
    const ir::Expr* bits =
        build_.binary(ir::BinaryOp::kBitOr, high, build_.convert(half(0), Scalar::kUint64));
    parts.push_back(build_.convert(bits, type->ir->scalar));
  }
  return parts.size() == 1 ? parts[0] : build_.construct(type->ir, std::move(parts));
}

const ir::Expr* Lowerer::to_texel(const ir::Expr* value, const Type* type) {
  if (!has_paired_texel(type)) return value;
  const ir::Expr* whole = build_.read(temporary(value));
  const Type* texel_type = types_.texel_of(type);
  std::vector<const ir::Expr*> parts;
  for (uint8_t i = 0; i < type->components(); ++i) {
    const ir::Expr* part = type->is_vector() ? build_.swizzle(whole, {i}) : whole;
    const ir::Type* half = build_.scalar_type(Scalar::kUint32);
    const ir::Expr* halves[2];
    if (type->scalar == Scalar::kFloat64) {
      halves[0] = build_.intrinsic(Intrinsic::asuint_low, half, {part});
      halves[1] = build_.intrinsic(Intrinsic::asuint_high, half, {part});
    } else {
      const ir::Type* wide = build_.scalar_type(Scalar::kUint64);
      const ir::Expr* bits = build_.convert(part, Scalar::kUint64);
      halves[0] = build_.convert(bits, Scalar::kUint32);
      halves[1] =
          build_.convert(build_.binary(ir::BinaryOp::kShiftRight, bits, build_.literal(wide, {32})),
                         Scalar::kUint32);
    }
    for (const ir::Expr* one : halves) parts.push_back(build_.convert(one, texel_type->ir->scalar));
  }
  return build_.construct(texel_type->ir, std::move(parts));
}

}  // namespace kaamos::hlsl
