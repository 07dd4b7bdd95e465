// SPDX-License-Identifier: MIT
//
// The counters of structured buffers, and append and consume buffers, which use them.
// [HLSL: RWStructuredBuffer, AppendStructuredBuffer, ConsumeStructuredBuffer]
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Counters : LowerPart {
 public:
  using LowerPart::LowerPart;

  std::optional<Value> call_counter_method(const Value& object, std::string_view name,
                                           std::vector<Value>& arguments, SourceLocation location);

 private:
  const ir::Expr* change_counter(const ir::Expr* resource, bool up, SourceLocation location);

  std::unordered_map<const BindingInfo*, uint8_t> counter_uses_;  // up, down
};

}  // namespace kaamos::hlsl
