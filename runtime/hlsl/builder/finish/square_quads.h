// SPDX-License-Identifier: MIT
//
// Quads of compute shaders. Four lanes of a wave in a row are a quad, and the threads of a group
// are numbered along SV_GroupIndex. Where a group's X and Y are even, threads get their ids in
// another order, in which each quad is a square of 2 x 2 threads.
// [HLSL SM 6.6 Derivatives: 2D Quads]
#pragma once

#include "runtime/hlsl/builder/facts.h"
#include "runtime/hlsl/builder/ir_builder.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// Whether the function itself reads other lanes of its quad, as derivatives do.
bool reads_quads(const FunctionFacts& function);

// Whether quads of this shader's groups are squares, in shader model 6.6 and higher.
bool has_square_quads(const ir::EntryPoint& entry);

// Whether a compute shader's groups are made of quads, so that it may take derivatives: X and Y are
// even, or X is a multiple of 4 and Y and Z are 1. [HLSL SM 6.6 Derivatives: Thread Groups and
// Quads]
bool has_quads(const ir::EntryPoint& entry);

// Puts a function around the entry point's that computes the ids of threads in the order of quads.
// It is a function of `module` afterwards.
void make_quads_square(ir::Module& module, IrBuilder& build, ir::EntryPoint& entry);

}  // namespace kaamos::hlsl
