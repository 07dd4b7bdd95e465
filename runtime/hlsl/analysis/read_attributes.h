// SPDX-License-Identifier: MIT
//
// Finds out whether a hit shader looks at the attributes it declares. One that does not may stand
// in a hit group whose intersection shader reports attributes of another type.
#pragma once

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// True also if it only may, for example by handing them to a function that writes them.
bool reads_attributes(const ir::EntryPoint& entry);

}  // namespace kaamos::hlsl
