// SPDX-License-Identifier: MIT
//
// Finding attributes such as [numthreads(8, 8, 1)].
#pragma once

#include <span>
#include <string_view>

#include "runtime/hlsl/check/names/symbols.h"
#include "runtime/hlsl/front/ast.h"

namespace kaamos::hlsl {

// The attribute with that name, ignoring case; null if there is none.
const Attribute* find_attribute(const FunctionInfo& function, std::string_view name);
const Attribute* find_attribute(std::span<const Attribute> attributes, std::string_view name);
// Ignoring case.
bool same_word(std::string_view a, std::string_view b);

}  // namespace kaamos::hlsl
