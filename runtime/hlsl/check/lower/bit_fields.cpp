// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/bit_fields.h"

#include "runtime/hlsl/check/lower/lowerer.h"

namespace kaamos::hlsl {
namespace {

uint64_t mask_of(uint32_t bits) {
  return bits >= 64 ? UINT64_MAX : (uint64_t{1} << bits) - 1;
}

Scalar signed_twin(Scalar scalar) {
  return scalar == Scalar::kUint16   ? Scalar::kInt16
         : scalar == Scalar::kUint64 ? Scalar::kInt64
                                     : Scalar::kInt32;
}

}  // namespace

Value BitFields::bit_field_of(const Value& owner, const FieldInfo& field) {
  Value value = lower_.places.field_of(owner, field.index, field.unit);
  if (value.failed()) return value;
  value.type = field.type;
  value.bits = &field;
  return value;
}

// The place that a bit field is part of.
Value BitFields::unit_of(const Value& value) {
  Value unit = value;
  unit.type = value.bits->unit;
  unit.bits = nullptr;
  unit.saved = nullptr;
  return unit;
}

const ir::Expr* BitFields::extract_bits(const ir::Expr* unit, const FieldInfo& field) {
  const Scalar scalar = field.unit->scalar;
  const uint32_t size = scalar_bytes(scalar, ScalarStorage::kBuffer) * 8;
  const auto shift = [&](ir::BinaryOp op, const ir::Expr* value, uint32_t bits) {
    return bits == 0 ? value
                     : build_.binary(op, value, build_.literal(value->type, {uint64_t{bits}}));
  };
  const ir::Expr* value = nullptr;
  if (is_signed_integer(field.type->scalar)) {
    value = shift(ir::BinaryOp::kShiftLeft, unit, size - field.bit_offset - field.bit_width);
    value = build_.convert(value, plain_scalar(signed_twin(scalar)));
    value = shift(ir::BinaryOp::kShiftRight, value, size - field.bit_width);
  } else {
    value = shift(ir::BinaryOp::kShiftRight, unit, field.bit_offset);
    value = build_.binary(ir::BinaryOp::kBitAnd, value,
                          build_.literal(value->type, {mask_of(field.bit_width)}));
  }
  return build_.convert(value, field.type->ir->scalar);
}

const ir::Expr* BitFields::insert_bits(const ir::Expr* unit, const FieldInfo& field,
                                       const ir::Expr* value) {
  const ir::Type* type = unit->type;
  const uint64_t mask = mask_of(field.bit_width);
  const uint64_t kept =
      ~(mask << field.bit_offset) & mask_of(scalar_bytes(type->scalar, ScalarStorage::kBuffer) * 8);
  const ir::Expr* part = build_.binary(ir::BinaryOp::kBitAnd, build_.convert(value, type->scalar),
                                       build_.literal(type, {mask}));
  part = build_.binary(ir::BinaryOp::kShiftLeft, part,
                       build_.literal(type, {uint64_t{field.bit_offset}}));
  return build_.binary(ir::BinaryOp::kBitOr,
                       build_.binary(ir::BinaryOp::kBitAnd, unit, build_.literal(type, {kept})),
                       part);
}

bool BitFields::require_whole_field(const Value& value, SourceLocation location,
                                    std::string_view purpose) {
  if (!value.bits) return true;
  report(CheckId::kBitFieldUse, location,
         {"bit field '" + std::string(value.bits->name) + "'", std::string(purpose)});
  return false;
}

}  // namespace kaamos::hlsl
