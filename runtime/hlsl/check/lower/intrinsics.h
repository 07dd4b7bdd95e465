// SPDX-License-Identifier: MIT
//
// Built-in functions: mathematics, bit casts and barriers here, the others by the parts that know
// them. [HLSL: Intrinsic functions]
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"
#include "runtime/hlsl/check/names/conversion_costs.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {

class Intrinsics : LowerPart {
 public:
  using LowerPart::LowerPart;

  // Returns what the conversions of a call's arguments cost where the function takes numbers; none
  // if it takes others, or these arguments do not fit.
  std::optional<ConversionCost> cost_of_builtin(std::string_view name,
                                                const std::vector<Value>& arguments);
  std::optional<Value> call_builtin(const NamePart& part, std::vector<Value>& arguments,
                                    SourceLocation location);
  Value call_select(std::vector<Value>& arguments, SourceLocation location);
  bool check_count(std::string_view name, size_t given, size_t lowest, size_t highest,
                   SourceLocation location);
  // Reports a vector of over four components.
  bool is_short_argument(std::string_view name, size_t index, const Value& argument);
  void use_in_stages(std::string_view name, uint32_t stages, SourceLocation location,
                     bool is_lenient = false);

 private:
  Value emit_barrier(uint32_t flags);
  Value call_barrier(std::vector<Value>& arguments, SourceLocation location);
  Value call_maths(const IntrinsicRule& rule, std::vector<Value>& arguments,
                   SourceLocation location);
  Value call_mul(std::vector<Value>& arguments, SourceLocation location);
  Value select_whole(const std::vector<Value>& arguments, SourceLocation location);
  Value call_and_or(bool is_and, std::vector<Value>& arguments, SourceLocation location);
  Value call_with_outputs(std::string_view name, std::vector<Value>& arguments,
                          SourceLocation location);
};

}  // namespace kaamos::hlsl
