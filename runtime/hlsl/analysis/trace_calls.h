// SPDX-License-Identifier: MIT
//
// The TraceRay and CallShader calls that an entry point can reach, with those of their arguments
// that are constant. Checked mode uses them to know which shader table records a dispatch can
// reach.
#pragma once

#include <cstdint>
#include <vector>

#include "kaamos/shader/abi.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

struct ReachedCalls {
  std::vector<shader::TraceCall> traces;
  std::vector<uint32_t> callables;  // shader indices; shader::kUnknownIndex
};

// Duplicates are removed. File names point into the module.
ReachedCalls collect_calls(const ir::Module& module, const ir::EntryPoint& entry);

// Returns whether any part of a TraceRay, CallShader or TraceRayInline (the structure's place,
// flags, mask or indices) is not a constant in the function that contains it. Checked code then
// reports it when it runs.
bool is_unknown(const ir::Module& module, const ir::Stmt& call);

}  // namespace kaamos::hlsl
