// SPDX-License-Identifier: MIT
//
// dx::HitObject and dx::MaybeReorderThread. A hit object is a struct of plain members, so that its
// values are read and made by expressions; only tracing, invoking and local root constants need the
// backend. [DXR: HitObject]
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class HitObjects : LowerPart {
 public:
  using LowerPart::LowerPart;

  // Nothing if the name is no function of `dx`.
  std::optional<Value> call_function(const QualifiedName& name, const CallExpr* call);
  Value call_method(const Value& object, const NamePart& part, std::vector<Value>& arguments,
                    SourceLocation location);

 private:
  Value call_static(const NamePart& part, std::vector<Value>& arguments, SourceLocation location);
  Value call_reorder(std::vector<Value>& arguments, SourceLocation location);
  Value make_miss(std::vector<Value>& arguments);
  Value from_query(std::vector<Value>& arguments, SourceLocation location);
  std::optional<Value> getter(const ir::Expr* hit, std::string_view name);
  Value set_record(const Value& object, const Value& index);
  Value attributes_of(const ir::Expr* hit, const NamePart& part, std::vector<Value>& arguments,
                      SourceLocation location);
  bool check_attributes(const Type* type, SourceLocation location);
  const ir::Expr* is(const ir::Expr* hit, uint32_t state);
  const ir::Expr* matrix_of(const ir::Expr* hit, uint32_t field);
  const ir::Expr* in_object_space(const ir::Expr* hit, uint32_t field, float w);
  void use(std::string_view name, uint32_t stages, SourceLocation location);
};

}  // namespace kaamos::hlsl
