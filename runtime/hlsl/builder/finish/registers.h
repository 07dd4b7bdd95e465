// SPDX-License-Identifier: MIT
//
// The registers of resources that have none in the source.
#pragma once

#include "runtime/hlsl/builder/facts.h"
#include "runtime/hlsl/builder/finish/finish_module.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// Gives every reachable binding a register, and makes Module::bindings of them.
void assign_registers(ir::Module& module, ModuleFacts& facts, FinishReport& report);
void check_overlaps(const ir::Module& module, const ModuleFacts& facts, FinishReport& report);

}  // namespace kaamos::hlsl
