// SPDX-License-Identifier: MIT
//
// Describes how a payload is laid out in memory, for debuggers and explanations.
#pragma once

#include <string>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// The text for shader::ExportDesc::payload_layout. Long values are cut off after a few hundred
// fields; null gives an empty text.
std::string value_layout(const ir::Type* type);

}  // namespace kaamos::hlsl
