// SPDX-License-Identifier: MIT
//
// Conversions between types, and initialiser lists, whose elements are converted one by one.
#pragma once

#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Conversions : LowerPart {
 public:
  using LowerPart::LowerPart;

  // A part of a value of a struct, array or vector, or such a value.
  struct Piece {
    const ir::Expr* expr;
    const Type* type;
  };

  ConversionRank rank(const Value& value, const Type* to);
  // `float[6]` and `float[2][3]`: as many scalars of one type in another shape.
  bool same_scalars(const Type* from, const Type* to) const;
  static bool is_base_of(const Type* base, const Type* type);
  ConversionRank rank(const Type* from, const Type* to);
  // An explicit conversion also allows what only a cast may do.
  const ir::Expr* convert(const Value& value, const Type* to, SourceLocation location,
                          bool is_explicit = false);
  const ir::Expr* convert_numeric(const ir::Expr* expr, const Type* from, const Type* to);
  static bool convertible_numeric(const Type* from, const Type* to);
  // Replaces literal types by their default types.
  Value settle(Value value);
  const ir::Expr* as_condition(const Value& value, SourceLocation location);
  void collect_pieces(const InitListExpr* list, std::vector<Piece>& pieces, int depth);
  const ir::Expr* build_from_pieces(const Type* type, std::vector<Piece> pieces,
                                    SourceLocation location, bool allow_extra);
  // `queue` is a stack: the next piece is at its back.
  void split(const Piece& piece, std::vector<Piece>& queue);

 private:
  const ir::Expr* lower_init_list(const InitListExpr* list, const Type* type);
  const ir::Expr* take(const Type* type, std::vector<Piece>& queue, bool& failed,
                       SourceLocation location);
};

}  // namespace kaamos::hlsl
