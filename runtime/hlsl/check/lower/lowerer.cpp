// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/lowerer.h"

#include <vector>

#include "runtime/hlsl/builder/constants.h"

namespace kaamos::hlsl {

LowerPart::LowerPart(Lowerer& lowerer)
    : lower_(lowerer),
      body_(lowerer.body),
      names_(lowerer.names),
      bench_(lowerer.bench),
      messages_(bench_.messages),
      types_(bench_.types),
      build_(bench_.build) {}

std::optional<int64_t> Lowerer::constant_integer(const Expr* expression, Scope* scope,
                                                 std::string_view purpose, const Type** type) {
  ir::Block ignored;
  const BodyScope saved(*this, body.function, &ignored, scope);
  Messages& messages = bench.messages;
  bench.build.location = messages.locate(expression->location);
  const Value value = expressions.lower(expression);
  if (value.failed()) return std::nullopt;
  if (!value.type) {  // a heap or an initialiser list: not a value yet
    messages.report(CheckId::kNotConstant, expression->location, {std::string(purpose)});
    return std::nullopt;
  }
  if (!(value.type->is_scalar() || value.type->is_enum())) {
    messages.report(CheckId::kNotAnInteger, expression->location,
                    {std::string(purpose), to_string(value.type)});
    return std::nullopt;
  }
  const ir::Expr* loaded = places.load(value);
  const auto bits = loaded ? evaluate(loaded) : std::nullopt;
  if (!bits || !ignored.empty()) {
    messages.report(CheckId::kNotConstant, expression->location, {std::string(purpose)});
    return std::nullopt;
  }
  if (value.type->is_scalar() && is_floating(value.type->scalar)) {
    messages.report(CheckId::kNotAnInteger, expression->location,
                    {std::string(purpose), to_string(value.type)});
    return std::nullopt;
  }
  if (type) *type = value.type;
  return static_cast<int64_t>((*bits)[0]);
}

Value Lowerer::value_of(const Expr* expression, Scope* scope) {
  ir::Block ignored;
  const BodyScope saved(*this, body.function, &ignored, scope);
  return expressions.lower(expression);
}

uint64_t Lowerer::component_count(const InitListExpr* list, Scope* scope) {
  ir::Block ignored;
  const BodyScope saved(*this, body.function, &ignored, scope);
  std::vector<Conversions::Piece> pieces;
  conversions.collect_pieces(list, pieces, 0);
  uint64_t count = 0;
  for (const Conversions::Piece& piece : pieces) count += flat_component_count(piece.type);
  return count;
}

}  // namespace kaamos::hlsl
