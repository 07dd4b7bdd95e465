// SPDX-License-Identifier: MIT
//
// Functions as pixel shaders need them, and compute shaders with derivatives, and what takes their
// place in all other stages.
#pragma once

#include "runtime/hlsl/builder/finish/finish_module.h"
#include "runtime/hlsl/builder/ir_builder.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// Copies the functions that these shaders reach, as said in quad_functions.cpp, sets levels of
// detail to 0 everywhere else, and sets EntryPoint::graphics_flags.
void make_quad_functions(ir::Module& module, IrBuilder& build, ModuleFacts& facts, bool has_errors);

}  // namespace kaamos::hlsl
