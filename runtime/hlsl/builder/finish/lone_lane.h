// SPDX-License-Identifier: MIT
//
// Replaces operations of several threads where a thread is alone: those of waves in ray tracing and
// vertex shaders, and levels of detail without derivatives.
#pragma once

#include "runtime/hlsl/builder/facts.h"
#include "runtime/hlsl/builder/ir_builder.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// Turns a kWave into an assignment of what it gives in a wave of one lane.
void make_wave_lone(IrBuilder& build, ir::Stmt& wave);
// The function's implicit levels of detail become 0.
void take_level_zero(IrBuilder& build, FunctionFacts& function);

}  // namespace kaamos::hlsl
