// SPDX-License-Identifier: MIT
//
// Which TraceRay and CallShader an entry point can reach, with what is constant of them: known to
// checked mode, which then knows what records of the shader tables a dispatch can reach.
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

// Equal ones stand once. File names point into the module.
ReachedCalls collect_calls(const ir::Module& module, const ir::EntryPoint& entry);

// Whether something of a TraceRay, CallShader or TraceRayInline is no constant of the function that
// holds it: where its structure stands, its flags, mask or indices. Then checked code tells of it
// when it runs.
bool is_unknown(const ir::Module& module, const ir::Stmt& call);

}  // namespace kaamos::hlsl
