// SPDX-License-Identifier: MIT
//
// Wave operations of pixel shaders, in which helper lanes take no part. [HLSL: Shader Model 6.0,
// Wave intrinsics, helper lanes; Shader Model 6.7, WaveOpsIncludeHelperLanes]
#pragma once

#include "runtime/hlsl/builder/ir_builder.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// Returns whether the operation gives another result if helper lanes take part: not those of quads,
// which they do take part in.
bool leaves_out_helpers(shader::WaveOp op);

// Appends `wave`, which leaves out helpers, to `out`. `takes_part` is a bool that is false in
// helpers.
void append_pixel_wave(IrBuilder& build, const ir::Stmt* wave, const ir::Expr* takes_part,
                       ir::Block& out);

}  // namespace kaamos::hlsl
