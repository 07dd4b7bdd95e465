// SPDX-License-Identifier: MIT
//
// Places: anything that can be assigned to, in variables and in memory. Nothing is read before
// load().
#pragma once

#include <cstdint>
#include <set>
#include <string_view>
#include <unordered_map>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Places : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value place(const ir::Variable* variable, const Type* type, bool is_const);
  const ir::Expr* load(const Value& value);
  void store(const Value& target, const ir::Expr* value);
  // Returns where a component of a numeric place in memory is, in bytes counted from the place.
  static uint32_t component_bytes(const Value& target, uint32_t component);
  Value field_of(const Value& base, uint32_t index, const Type* type);
  Value base_of(const Value& value, StructInfo* base);
  // The same of what is only assigned to, which may be a cast.
  bool require_target(const Value& value, SourceLocation location, std::string_view purpose);
  // What a write to a cast changes: `(float2)v = x` leaves v.zw alone.
  Value place_under_cast(const Value& value);
  // Whether anything is stored in the variable or a part of it.
  bool is_assigned(const ir::Variable* variable) const { return assigned_.contains(variable); }
  bool require_place(const Value& value, SourceLocation location, std::string_view purpose);
  void freeze(Value& value, size_t* position);
  const ir::Expr* frozen(const ir::Expr* expr, size_t* position);
  static bool is_fixed(const ir::Expr* expr);
  static bool mentions(const ir::Expr* expr, const ir::Variable* variable);
  const ir::Expr* binding_value(BindingInfo* binding, const ir::Expr* index);

  // The binding that a resource is, or is an element of; null if there is none.
  BindingInfo* binding_of(const ir::Expr* resource) const {
    const auto found = binding_of_.find(resource);
    return found == binding_of_.end() ? nullptr : found->second;
  }

 private:
  void store_memory(const Value& target, const ir::Expr* value);
  void store_component(const Value& target, uint32_t component, const ir::Expr* value);
  const ir::Expr* freeze_place(const ir::Expr* expr, size_t* position);

  std::set<const ir::Variable*> assigned_;
  std::unordered_map<const ir::Expr*, BindingInfo*> binding_of_;  // for kBinding
};

}  // namespace kaamos::hlsl
