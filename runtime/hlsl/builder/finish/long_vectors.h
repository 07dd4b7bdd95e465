// SPDX-License-Identifier: MIT
//
// Vectors of over four components, which a front end lowers like any other. No executor has them:
// they become arrays of scalars, and what is done with them loops over the components.
// [HLSL: 0026 Long vectors]
#pragma once

#include "runtime/hlsl/builder/ir_builder.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// For a finished module. Expressions of long vectors, and those around them, are new ones.
void make_long_vectors_arrays(ir::Module& module, IrBuilder& build);

}  // namespace kaamos::hlsl
