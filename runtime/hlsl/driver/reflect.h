// SPDX-License-Identifier: MIT
//
// Describes what a library exports and binds, as JSON for tools and human readers.
#pragma once

#include <string>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// {"name", "target", "exports": [{"name", "mangled", "stage", ...}], "bindings": [...],
// "subobjects": [...]}, followed by a newline.
std::string reflect_json(const ir::Module& module);

}  // namespace kaamos::hlsl
