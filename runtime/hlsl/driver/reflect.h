// SPDX-License-Identifier: MIT
//
// What a library exports and binds, as JSON for tools and people.
#pragma once

#include <string>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// {"name", "target", "exports": [{"name", "mangled", "stage", ...}], "bindings": [...],
// "subobjects": [...]}, ends with a line end.
std::string reflect_json(const ir::Module& module);

}  // namespace kaamos::hlsl
