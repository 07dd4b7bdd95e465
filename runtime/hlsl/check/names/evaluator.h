// SPDX-License-Identifier: MIT
//
// Answers what names ask about expressions: a size, a template argument or the type of `auto` may
// be any expression, and the lowerer knows what it is.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/hlsl/check/names/symbols.h"

namespace kaamos::hlsl {

class Evaluator {
 public:
  virtual ~Evaluator() = default;
  // Reports an error and returns nothing if it is no constant integer, which `purpose` needs.
  // `type` receives the expression's type.
  virtual std::optional<int64_t> constant_integer(const Expr* expression, Scope* scope,
                                                  std::string_view purpose,
                                                  const Type** type = nullptr) = 0;
  virtual Value value_of(const Expr* expression, Scope* scope) = 0;
  // Returns how many scalars, vectors and so on the list gives. [flat_component_count]
  virtual uint64_t component_count(const InitListExpr* list, Scope* scope) = 0;
};

}  // namespace kaamos::hlsl
